// SPDX-License-Identifier: MIT
#pragma once

#include "sim/error.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

// Faults of models, told as faults of the file that they come from. Models check their parameters
// and know nothing of files; whoever makes one for a scenario knows the place.

namespace rovernet {

/// Runs make() for a value of a file. A std::invalid_argument in it becomes an error in the input
/// at `where`; an InputError keeps its own place.
///
///   const Movement move = located(table.where, [&] { return Movement(Patrol{table.path}); });
///
/// @param where  place of the value in the input
/// @return what make() returns
auto located(const Location& where, auto&& make) {
    try {
        return make();
    } catch (const InputError&) {
        throw;
    } catch (const std::invalid_argument& error) {
        throw InputError(where, error.what());
    }
}

/// Runs make() for a file that the input names. An error at a line of that file stays as it is. One
/// that concerns the file as a whole (it is missing, say) is told at the place that names it, as
/// "KEY: FILE: what is wrong".
/// @param where  place of the name in the input; without a line, errors stay as they are
/// @param key    key whose value is the name
/// @return what make() returns
auto located_file(const Location& where, std::string_view key, auto&& make) {
    try {
        return make();
    } catch (const InputError& error) {
        if (error.where().line > 0 || where.line == 0) throw;
        throw InputError(where, fmt::format("{}: {}", key, error.what()));
    }
}

}  // namespace rovernet
