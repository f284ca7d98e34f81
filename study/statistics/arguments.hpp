// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

namespace rovernet {

// Checks of arguments of statistical functions. The error message begins with `owner`.

/// Checks that every value is finite. @throws std::invalid_argument if not
void check_finite(std::span<const double> values, std::string_view owner);

/// Checks that 0 < value < 1. @throws std::invalid_argument naming the value if not
void check_open_unit(double value, std::string_view name, std::string_view owner);

}  // namespace rovernet
