// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "mobility/way.hpp"
#include "sim/fields.hpp"

#include <cstddef>
#include <string_view>
#include <vector>

namespace rovernet {

/// Patrol from place to place and round again for ever, around the walls where there are any.
///
/// A place without a way to it ends the movement: Blocked. A round without any distance to go ends
/// it, too: AtRest.
struct Patrol {
    static constexpr std::string_view name = "patrol";

    std::vector<Vec3> path = {};  ///< [m], at least one place
    MetersPerSecond speed{1};     ///< [m/s], > 0

    static constexpr auto fields() {
        return describe(
            field("path", &Patrol::path, "places to go to, in turn; after the last the first"),
            field("speed", &Patrol::speed, positive, "between the places"));
    }

    /// @throws std::invalid_argument for a parameter out of its range
    Step next_leg(Mover& mover);

    /// Progress of the robot; left to the model.
    struct Progress {
        std::size_t next = 0;  // place of the path
        Way way = {};          // way to the place before
    } progress = {};
};

}  // namespace rovernet
