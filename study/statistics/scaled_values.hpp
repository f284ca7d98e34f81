// SPDX-License-Identifier: MIT
#pragma once

#include "study/statistics/metric_bounds.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace rovernet {

/// Values with two bounds on the scale from 0 to 1, and mirrored on it. What holds for the lower
/// end of an interval of the mirrored values holds for the upper end of the values.
struct ScaledValues {
    std::vector<double> values;    ///< (v - low) / (high - low)
    std::vector<double> mirrored;  ///< 1 - values
    double low, width;             ///< of the bounds, in the metric's unit

    double mean() const;
    /// Point of the scale in the metric's unit.
    double unscaled(double share) const { return low + width * share; }
};

/// Scales values to their bounds.
/// @param  owner  function whose caller is told
/// @throws std::invalid_argument without values, without bounds, if a value is not within them, or
///         if confidence is not in (0, 1)
ScaledValues scaled_values(std::span<const double> values, const Bounds& bounds, double confidence,
                           std::string_view owner);

}  // namespace rovernet
