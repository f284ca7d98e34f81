// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "mobility/way.hpp"
#include "sim/fields.hpp"

#include <cstddef>
#include <string_view>
#include <vector>

namespace rovernet {

/// Patrol: endless movement from place to place in a cycle, around the walls if there are any.
///
/// If there is no path to a place, the movement ends with Blocked. If all places are equal, the
/// movement ends with AtRest.
struct Patrol {
    static constexpr std::string_view name = "patrol";

    std::vector<Vec3> path = {};  ///< positions to visit in a cycle [m], one or more
    MetersPerSecond speed{1};     ///< speed [m/s], > 0

    static constexpr auto fields() {
        return describe(
            field(
                "path", &Patrol::path,
                "places to go to, one after the other; after the last place, the first one again"),
            field("speed", &Patrol::speed, positive, "speed between the places"));
    }

    /// @throws std::invalid_argument for a parameter out of its range
    Step next_leg(Mover& mover);

    /// State of the robot in this movement, for the model only.
    struct Progress {
        std::size_t next = 0;  // index of the next place of the path
        Way way = {};          // path to the previous place
    } progress = {};
};

}  // namespace rovernet
