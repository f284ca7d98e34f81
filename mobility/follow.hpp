// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "sim/ids.hpp"

#include <string_view>

namespace rovernet {

/// Movement of a robot (follower) behind another robot (leader). At intervals of `every`, the
/// follower reads the leader's position and moves along the path to this position, around the
/// walls, until the remaining path is `distance` long.
///
/// The follower chooses its speed, at most `speed`, so that the movement takes the whole interval.
/// It stands while the path to the leader is shorter than `distance`. Behind a leader with constant
/// speed v < `speed` on a straight line, the distance at each update is `distance` + v `every`. If
/// there is no path, the follower stands until the next update. Its height is constant.
struct Follow {
    static constexpr std::string_view name = "follow";
    static constexpr AtDoors at_doors = AtDoors::looks;

    NodeId leader = {};
    Meters distance{2};                        ///< kept distance [m], >= 0, along the path
    MetersPerSecond speed{1};                  ///< largest speed behind the leader [m/s], > 0
    Duration every = std::chrono::seconds{1};  ///< time between two path updates [ns], from 1 us

    static constexpr auto fields() {
        return describe(field("distance", &Follow::distance, non_negative,
                              "distance that the robot keeps from the leader, along the path"),
                        field("speed", &Follow::speed, positive, "largest speed of the robot"),
                        field("every", &Follow::every, step_length,
                              "time between two updates of the path to the leader"));
    }

    /// @throws std::invalid_argument for a parameter out of its range or an unknown leader
    Step next_leg(Mover& mover);
};

}  // namespace rovernet
