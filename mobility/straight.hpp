// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"

#include <optional>

namespace rovernet {

/// Straight movement to one position, through any obstacles, for recorded movements: it is limited
/// neither by the robot's top_speed nor by its turn_rate.
struct Straight {
    static constexpr AtDoors at_doors = AtDoors::passes;

    Vec3 to;                                     ///< goal [m]
    MetersPerSecond speed{1};                    ///< speed [m/s], > 0
    std::optional<Time> arrival = std::nullopt;  ///< time of arrival; none: given by `speed`

    Step next_leg(Mover& mover) {
        Mover unlimited = mover;
        unlimited.top_speed = Mover::any_speed;
        if (mover.position == to && (!arrival || *arrival <= mover.now)) return AtRest{};
        if (arrival && *arrival > mover.now) return straight_leg(unlimited, to, *arrival);
        return straight_leg(unlimited, to, speed);
    }
};

}  // namespace rovernet
