// SPDX-License-Identifier: MIT
#pragma once

#include "sim/error.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

// Errors of models, reported at the place in the file that caused them. Models check their
// parameters and know nothing of files; the code that builds a model from a scenario knows the
// place.

namespace rovernet {

/// Runs make() for a value of an input file. A std::invalid_argument in it becomes an InputError at
/// `where`; an InputError keeps its file position.
///
///   const Movement move = located(table.where, [&] { return Movement(Patrol{table.path}); });
///
/// @param where  file position of the value
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

/// Runs make() for a file that the input names. An error at a line of that file stays as it is. An
/// error about the whole file (a missing file, say) is reported at the line that names the file, as
/// "KEY: FILE: MESSAGE".
/// @param where  file position of the name in the input; without a line, errors stay as they are
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
