// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/value.hpp"

#include <string>
#include <string_view>

namespace rovernet {

/// Reads a TOML file. @throws InputError with file:line:column; for a file that is missing, a
/// directory, unreadable or larger than 64 MiB, with the file alone
Value read_toml(const std::string& path);

/// Reads TOML from a text; `source` stands for the file in errors.
Value parse_toml(std::string_view text, const std::string& source);

/// The table as a TOML document.
std::string to_toml(const Table& document);

/// Applies "path=value" to a scenario's document, as the command line's --set does: `radio.power`,
/// `robot.NAME.radio.power`, `traffic.0.start`. The value is TOML, or else a bare string; numbers
/// are in SI units.
/// @throws InputError whose place is the option
void set_option(Table& document, const std::string& assignment);

}  // namespace rovernet
