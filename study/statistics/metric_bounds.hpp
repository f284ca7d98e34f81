// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace rovernet {

/// The range that a metric's values lie in, in its unit; nothing where it has no end.
struct Bounds {
    std::optional<double> low, high;

    bool closed() const { return low && high; }
    /// Whether every value lies in it.
    bool hold(std::span<const double> values) const;
    friend bool operator==(const Bounds&, const Bounds&) = default;
};

/// The bounds of a metric by its name: 0 to 1 for shares, from 0 for times and counts. A metric of
/// one flow or robot, "delivery_ratio.NAME", has those of the metric before the dot.
///
/// `reach` passes 1 where robots move or relay late. Its bounds are 0 and 1 all the same; where a
/// value lies beyond them they do not hold, and who asks hold() sees it.
Bounds bounds_of(std::string_view metric);

/// The bounds of the difference of two values of a metric: -(high - low) to high - low.
Bounds difference_bounds(const Bounds& bounds);

}  // namespace rovernet
