// SPDX-License-Identifier: MIT
#include "study/statistics/arguments.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace rovernet {

void check_finite(std::span<const double> values, std::string_view owner) {
    for (const double v : values) {
        if (std::isfinite(v)) continue;
        throw std::invalid_argument(fmt::format("{}: values must be finite, got {}", owner, v));
    }
}

void check_open_unit(double value, std::string_view name, std::string_view owner) {
    if (value > 0 && value < 1) return;
    throw std::invalid_argument(
        fmt::format("{}: {} must be above 0 and below 1, got {}", owner, name, value));
}

}  // namespace rovernet
