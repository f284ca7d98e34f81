// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace rovernet {

/// Natural bounds of a metric's values, in the metric's unit; none: no bound on that side.
struct Bounds {
    std::optional<double> low, high;

    bool closed() const { return low && high; }
    /// Whether every value lies within the bounds.
    bool hold(std::span<const double> values) const;
    friend bool operator==(const Bounds&, const Bounds&) = default;
};

/// Bounds of a metric, by its name. Shares have the bounds 0 and 1 (saved_rebroadcasts, which may
/// be negative, only the upper bound 1). Times and counts have only the lower bound 0. A metric of
/// a flow or robot, "delivery_ratio.NAME", has the bounds of the metric before the dot.
///
/// The metric `reach` may exceed 1 if robots move or forward late. Its bounds are nevertheless 0
/// and 1; callers must check values by Bounds::hold().
Bounds bounds_of(std::string_view metric);

/// Bounds (low - high and high - low) of the difference of two values of a metric with the given
/// bounds. No bounds unless both given bounds exist.
Bounds difference_bounds(const Bounds& bounds);

}  // namespace rovernet
