// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/toml_mistake.hpp"

#include <optional>
#include <string_view>

namespace rovernet {

/// Whether an error of the parser is about the table header in the line above the one at which the
/// parser stopped.
/// @param line         whole line at which the parser stopped
/// @param at           byte of the line at which the parser stopped, from 0
/// @param description  message of the parser
bool is_about_line_above(std::string_view line, std::size_t at, std::string_view description);

/// Mistake that a key or a table occurs twice, or that a table adds keys to a value that is not an
/// open table; none if the parser's error is a different one. The name is read from the line,
/// because the parser's message lacks the name or garbles it.
/// @param line         whole line with the key or header
/// @param at           byte of the line at which the parser stopped, from 0
/// @param number       number of the line, from 1
/// @param column       column of this byte, in characters from 1
/// @param description  message of the parser
std::optional<TomlMistake> toml_repetition(std::string_view line, std::size_t at, int number,
                                           int column, std::string_view description);

}  // namespace rovernet
