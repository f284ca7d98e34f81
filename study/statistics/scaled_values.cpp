// SPDX-License-Identifier: MIT
#include "study/statistics/scaled_values.hpp"

#include "study/statistics/arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace rovernet {
namespace {

void check(std::span<const double> values, const Bounds& bounds, double confidence,
           std::string_view owner) {
    check_finite(values, owner);
    check_open_unit(confidence, "confidence", owner);
    if (values.empty())
        throw std::invalid_argument(fmt::format("{}: expected at least one value", owner));
    if (!bounds.closed() || !(*bounds.low < *bounds.high)) {
        throw std::invalid_argument(
            fmt::format("{}: expected a lower and an upper bound of the values", owner));
    }
    if (bounds.hold(values)) return;
    throw std::invalid_argument(fmt::format("{}: a value is outside the range from {} to {}", owner,
                                            *bounds.low, *bounds.high));
}

}  // namespace

double ScaledValues::mean() const {
    double sum = 0;
    for (const double v : values) sum += v;
    return sum / static_cast<double>(values.size());
}

ScaledValues scaled_values(std::span<const double> values, const Bounds& bounds, double confidence,
                           std::string_view owner) {
    check(values, bounds, confidence, owner);
    const double width = *bounds.high - *bounds.low;
    ScaledValues result{.values = {}, .mirrored = {}, .low = *bounds.low, .width = width};
    for (const double v : values) {
        const double x = std::clamp((v - *bounds.low) / width, 0.0, 1.0);
        result.values.push_back(x);
        result.mirrored.push_back(1 - x);
    }
    return result;
}

}  // namespace rovernet
