// SPDX-License-Identifier: MIT
#pragma once

#include "sim/error.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

// Errors of models, reported with the file position of the value that caused them. A model checks
// its parameters but does not know their file positions. The code that builds the model from a
// scenario adds the position.

namespace rovernet {

/// Runs make() for a value of an input file. If make() throws std::invalid_argument, throws an
/// InputError at `where` instead. An InputError from make() keeps its file position.
///
///   const Movement move = located(table.where, [&] { return Movement(Patrol{table.path}); });
///
/// @param where  file position of the value
/// @return result of make()
auto located(const Location& where, auto&& make) {
    try {
        return make();
    } catch (const InputError&) {
        throw;
    } catch (const std::invalid_argument& error) {
        throw InputError(where, error.what());
    }
}

/// Runs make() for a file that the input names. An InputError at a line of that file is not
/// changed. An InputError about the whole file (a missing file, say) is reported at the line that
/// names the file, as "KEY: FILE: MESSAGE".
/// @param where  file position of the name in the input, or its option; if `where` is neither,
///               errors of make() are not changed
/// @param key    key whose value is the name
/// @return result of make()
auto located_file(const Location& where, std::string_view key, auto&& make) {
    try {
        return make();
    } catch (const InputError& error) {
        if (error.where().line > 0 || (where.line == 0 && !where.is_option)) throw;
        throw InputError(where, fmt::format("{}: {}", key, error.what()));
    }
}

}  // namespace rovernet
