// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace rovernet {

/// Natural bounds of a metric's values, in the metric's unit; none: unbounded on that side.
struct Bounds {
    std::optional<double> low, high;

    bool closed() const { return low && high; }
    /// Whether every value lies within the bounds.
    bool hold(std::span<const double> values) const;
    friend bool operator==(const Bounds&, const Bounds&) = default;
};

/// Bounds of a metric, by its name: 0 to 1 for shares (at most 1, but maybe below 0, for
/// saved_rebroadcasts); 0 and no upper bound for times and counts. A metric of a flow or robot,
/// "delivery_ratio.NAME", has the bounds of the metric before the dot.
///
/// The metric `reach` may exceed 1 if robots move or forward late. Its bounds are nevertheless 0
/// and 1; callers must check values by Bounds::hold().
Bounds bounds_of(std::string_view metric);

/// Bounds of the difference of two values of a metric that has the given bounds: low - high to
/// high - low; none unless both bounds exist.
Bounds difference_bounds(const Bounds& bounds);

}  // namespace rovernet
