// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"

#include <string_view>

namespace rovernet {

/// The speeds that a movement draws from: between two bounds, none above the robot's top speed.
struct SpeedRange {
    double low;   ///< [m/s], >= 0
    double high;  ///< [m/s], > 0, >= low

    /// @throws std::invalid_argument unless 0 <= min <= max and max > 0, finite
    SpeedRange(MetersPerSecond min, MetersPerSecond max, const Mover& mover,
               std::string_view model);

    /// A trip's speed [m/s] for u uniform in (0, 1): all speeds are equally likely.
    double of_a_trip(double u) const { return low + u * (high - low); }
    /// The speed [m/s] at a moment, for u uniform in (0, 1) and low > 0: of density 1/v, as a slow
    /// trip lasts longer. Its mean is (high - low) / ln(high / low).
    double at_a_moment(double u) const;
    /// The mean of 1/v over the trips [s/m]: ln(high / low) / (high - low); low > 0.
    double mean_slowness() const;
};

}  // namespace rovernet
