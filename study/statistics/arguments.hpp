// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

namespace rovernet {

// Checks of arguments of statistical functions.

/// Checks that every value is finite. @throws std::invalid_argument, with a message that begins
/// with the function name `owner`, if not
void check_finite(std::span<const double> values, std::string_view owner);

/// Checks that 0 < value < 1. @throws std::invalid_argument, with a message that begins with the
/// function name `owner` and names the argument `name`, if not
void check_open_unit(double value, std::string_view name, std::string_view owner);

}  // namespace rovernet
