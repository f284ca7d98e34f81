// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"

#include <string>
#include <string_view>

// TOML files as documents of Values, and back. toml++ is used in toml.cpp alone.

namespace rovernet {

/// Path that stands for standard input.
inline constexpr std::string_view standard_input = "-";

/// Reads a TOML file, or standard input ("-"), whose text is kept for a second reading. Keys are in
/// the order of the file, and every value knows its place.
/// @throws InputError with file:line:column; for a file that is missing, a directory, unreadable or
/// larger than 64 MiB, with the file alone
Value read_toml(const std::string& path);

/// Reads TOML from a text.
/// @param source  name that stands for the file in errors
/// @throws InputError with source:line:column
Value parse_toml(std::string_view text, const std::string& source);

/// TOML document of a table: [KEY] for a table in it, [[KEY]] for each of a list of tables, deeper
/// ones in one line. It ends with a newline.
std::string to_toml(const Table& document);

/// TOML of a value as it stands behind a key: "15 dBm" with its quotes, [1, 2], { a = 1 }.
std::string to_toml(const Value& value);

/// Text of a value for people: as to_toml(), but a text without its quotes.
std::string plain_text(const Value& value);

/// Sets the value at `path` in a scenario's document: `radio.power`, `robot.NAME.radio.power`,
/// `traffic.0.start`. In a list a step is the number of an item, or the `name` in it. Tables on the
/// way are made if they are not there.
/// @param where  place of what is made, in later errors
/// @throws InputError at `where` if the path leads nowhere
void set_value(Value& document, const std::string& path, Value value, const Location& where);

/// Applies "path=value", as the command line's --set does. The value is TOML, or else a bare
/// string; numbers are in SI units.
/// @param typed  option as the user typed it, for errors
/// @throws InputError whose place is that option
void set_option(Value& document, const std::string& assignment, const std::string& typed);

}  // namespace rovernet
