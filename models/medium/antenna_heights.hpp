// SPDX-License-Identifier: MIT
#pragma once

#include "sim/legs.hpp"
#include "sim/units.hpp"

#include <algorithm>
#include <limits>

namespace rovernet {

/// Heights (z) of all antennas of a medium, on all legs so far. The range of some propagation
/// models depends on the largest height. If all heights are equal, a loss of shape by_heights
/// depends on distance alone.
struct AntennaHeights {
    /// Upper bound of the antenna heights [m]; minus infinity if there are no antennas.
    Meters highest{-std::numeric_limits<double>::infinity()};
    /// Height of the first antenna [m].
    Meters first{0};
    /// Whether all antennas have had the height `first`.
    bool are_equal = true;

    /// Adds the heights of an antenna while its robot is on a leg.
    /// @param above  height of the antenna above the robot's z [m]
    void take(const Leg& leg, Meters above) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        const double begin = leg.from.z + above.value;
        if (highest.value == -infinity) first = {begin};
        are_equal =
            are_equal && begin == first.value && leg.to.z == leg.from.z && leg.velocity.z == 0;
        const bool climbs_on = leg.end == never && leg.velocity.z > 0;
        const double top = climbs_on ? infinity : std::max(leg.from.z, leg.to.z) + above.value;
        highest = {std::max(highest.value, top)};
    }
};

}  // namespace rovernet
