// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/value.hpp"

#include <string>
#include <string_view>

namespace rovernet {

/// The path that stands for standard input.
inline constexpr std::string_view standard_input = "-";

/// Reads a TOML file, or standard input ("-"), whose text is kept for a second reading.
/// @throws InputError with file:line:column; for a file that is missing, a directory, unreadable or
/// larger than 64 MiB, with the file alone
Value read_toml(const std::string& path);

/// Reads TOML from a text; `source` stands for the file in errors.
Value parse_toml(std::string_view text, const std::string& source);

/// The table as a TOML document.
std::string to_toml(const Table& document);

/// A value as it stands behind a key: "15 dBm" with its quotes, [1, 2], { a = 1 }.
std::string to_toml(const Value& value);

/// The same for people: a text without its quotes.
std::string plain_text(const Value& value);

/// Sets the value at `path` in a scenario's document: `radio.power`, `robot.NAME.radio.power`,
/// `traffic.0.start`. Tables on the way are made if they are not there.
/// @param where  stands for the place of what is made, in later errors
/// @throws InputError at `where` if the path leads nowhere
void set_value(Value& document, const std::string& path, Value value, const Location& where);

/// Applies "path=value", as the command line's --set does. The value is TOML, or else a bare
/// string; numbers are in SI units. @throws InputError whose place is the option as it was `typed`
void set_option(Value& document, const std::string& assignment, const std::string& typed);

}  // namespace rovernet
