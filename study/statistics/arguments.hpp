// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

namespace rovernet {

// Checks of arguments, for the statistics of study/. `owner` begins the error's text.

/// @throws std::invalid_argument unless every value is finite
void check_finite(std::span<const double> values, std::string_view owner);

/// @throws std::invalid_argument, naming it, unless 0 < value < 1
void check_open_unit(double value, std::string_view name, std::string_view owner);

}  // namespace rovernet
