// SPDX-License-Identifier: MIT
#pragma once

#include "study/statistics/metric_bounds.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace rovernet {

/// Bounded values scaled to 0 ... 1, and their mirror images (1 - scaled value). The lower end of
/// an interval for the mean of the mirrored values gives the upper end of the interval for the mean
/// of the values.
struct ScaledValues {
    std::vector<double> values;    ///< (v - low) / (high - low) of each value v
    std::vector<double> mirrored;  ///< 1 - x of each scaled value x
    double low, width;  ///< lower bound, and difference of the bounds, in the metric's unit

    double mean() const;
    /// Converts a scaled value back to the metric's unit.
    double unscaled(double share) const { return low + width * share; }
};

/// Scales values to their bounds, and checks the arguments of the calling function.
/// @param  confidence  confidence level of the calling function, for the check only
/// @param  owner  name of the calling function, for the error message
/// @throws std::invalid_argument without values, without bounds, if a value is out of bounds, or if
///         confidence is not in (0, 1)
ScaledValues scaled_values(std::span<const double> values, const Bounds& bounds, double confidence,
                           std::string_view owner);

}  // namespace rovernet
