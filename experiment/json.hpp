// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/value.hpp"

#include <string>

namespace rovernet {

/// The value as a JSON document: keys in their order, numbers in the fewest digits that read back
/// the same, two blanks of indentation, a newline at the end. NaN and infinity become null.
std::string to_json(const Value& value);

}  // namespace rovernet
