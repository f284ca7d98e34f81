// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/value.hpp"

#include <string>
#include <string_view>

namespace rovernet {

/// The value as a JSON document: keys in their order, numbers in the fewest digits that read back
/// the same, two blanks of indentation, a newline at the end. NaN and infinity become null.
std::string to_json(const Value& value);

/// The same in one line, without a newline.
std::string to_json_line(const Value& value);

/// Reads a JSON document; null is an empty Value. @throws InputError without a place
Value parse_json(std::string_view text);

}  // namespace rovernet
