// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"

#include <string_view>

namespace rovernet {

/// Range of the speeds that a movement model draws, limited by the robot's top speed.
struct SpeedRange {
    double low;   ///< lowest speed [m/s], >= 0
    double high;  ///< highest speed [m/s], > 0, >= low

    /// @throws std::invalid_argument unless 0 <= min <= max and max > 0, finite
    SpeedRange(MetersPerSecond min, MetersPerSecond max, const Mover& mover,
               std::string_view model);

    /// Speed of a trip [m/s], for u uniform in (0, 1): uniformly distributed.
    double of_a_trip(double u) const { return low + u * (high - low); }
    /// Speed v at a random time [m/s], for u uniform in (0, 1) and low > 0. Its density is
    /// proportional to 1/v, because slow trips last longer. The mean of v is (high - low) / ln(high
    /// / low).
    double at_a_moment(double u) const;
    /// Mean of 1 / speed over the trips [s/m]: ln(high / low) / (high - low), for low > 0.
    double mean_slowness() const;
};

}  // namespace rovernet
