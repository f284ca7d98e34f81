// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"

#include <cstddef>
#include <string>
#include <string_view>

// Conversion between TOML files and documents of Values. Only toml.cpp uses toml++.

namespace rovernet {

/// Path that stands for standard input.
inline constexpr std::string_view standard_input = "-";

/// Reads a TOML file, or standard input ("-"). The text of standard input is stored, so
/// that a second call can read the text again. Keys are in the order of the file. Every value has
/// its file position.
/// @throws InputError with file:line:column; with the file name alone if the file is missing, a
/// directory, unreadable or larger than 64 MiB
Value read_toml(const std::string& path);

/// Reads TOML from a text.
/// @param source  name that stands for the file in errors
/// @throws InputError with source:line:column
Value parse_toml(std::string_view text, const std::string& source);

/// TOML document of a table: [KEY] for a nested table, [[KEY]] for each table of a list; tables
/// nested deeper are written in one line. The text ends with a newline.
std::string to_toml(const Table& document);

/// TOML of a value as written after a key: "15 dBm" with its quotes, [1, 2], { a = 1 }.
std::string to_toml(const Value& value);

/// Text of a value for users: the TOML of the value, but a string is printed without quotes.
std::string plain_text(const Value& value);

/// Takes the first key from a path of keys that are joined by dots: `robot` from `robot.A.radio`. A
/// key with dots is in quotes: `"flow.0".radio`.
/// @return the key without quotes; empty if the path does not begin with a complete key
std::string_view take_key(std::string_view& path);

/// Position of the first `=` of an assignment that is not in quotes; npos if there is none.
std::size_t find_equals(std::string_view assignment);

/// Sets the value at `path` in a scenario's document: `radio.power`, `robot.NAME.radio.power`,
/// `robot."flow.0".radio.power`, `traffic.0.start`. An item of a list is given by its number or by
/// its `name`. Missing tables along the path are created. If the rest of the path is an existing
/// key with dots, as in [study] vary, this key is meant, also without quotes.
/// @param where  file position given to the new values, for later error messages
/// @throws InputError at `where` if the path does not exist and cannot be created
void set_value(Value& document, const std::string& path, Value value, const Location& where);

/// First key of an assignment "path=value" of the option --set: "scene" for "scene.map=m.png".
std::string_view first_key(std::string_view assignment);

/// Applies an assignment "path=value" of the command line's option --set to a scenario's document.
/// The value is TOML, or a string without quotes. Numbers without a unit are in SI units.
/// @param typed  option as the user typed it, for error messages
/// @throws InputError at the option `typed`, instead of a file position
void set_option(Value& document, const std::string& assignment, const std::string& typed);

}  // namespace rovernet
