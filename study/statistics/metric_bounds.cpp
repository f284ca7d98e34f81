// SPDX-License-Identifier: MIT
#include "study/statistics/metric_bounds.hpp"

#include <algorithm>
#include <array>

namespace rovernet {
namespace {

struct BoundedMetric {
    std::string_view name;
    Bounds bounds;
};

/// Metrics that are not simply >= 0.
constexpr std::array<BoundedMetric, 3> bounded_metrics = {{
    {"delivery_ratio", {0.0, 1.0}},
    {"reach", {0.0, 1.0}},
    {"saved_rebroadcasts", {std::nullopt, 1.0}},  // < 0 where relays do not count as receivers
}};

}  // namespace

bool Bounds::hold(std::span<const double> values) const {
    return std::ranges::all_of(
        values, [this](double v) { return !(low && v < *low) && !(high && v > *high); });
}

Bounds bounds_of(std::string_view metric) {
    const std::string_view name = metric.substr(0, metric.find('.'));
    const auto found = std::ranges::find(bounded_metrics, name, &BoundedMetric::name);
    return found == bounded_metrics.end() ? Bounds{0.0, std::nullopt} : found->bounds;
}

Bounds difference_bounds(const Bounds& bounds) {
    if (!bounds.closed()) return {};
    const double width = *bounds.high - *bounds.low;
    return {-width, width};
}

}  // namespace rovernet
