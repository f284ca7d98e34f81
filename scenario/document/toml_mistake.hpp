// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace rovernet {

/// Mistake in a text that is not TOML.
struct TomlMistake {
    std::string message;  ///< what was found, and a hint on the probable mistake
    int line = 0;         ///< line of the mistake, from 1
    int column = 0;       ///< column of the mistake, in characters from 1
};

/// Explains an error of the TOML parser by the characters around its place: a missing or
/// typographic quote, a comma behind a value, two keys on one line, a key that occurs twice.
/// @param text         whole text
/// @param line         line at which the parser stopped, from 1
/// @param column       column at which the parser stopped, in characters from 1
/// @param description  message of the parser
TomlMistake toml_mistake(std::string_view text, int line, int column, std::string_view description);

}  // namespace rovernet
