// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"

#include <optional>

namespace rovernet {

/// Straight to one place, through whatever stands in between: for movements that were recorded.
struct Straight {
    static constexpr AtDoors at_doors = AtDoors::passes;

    Vec3 to;                                     ///< [m]
    MetersPerSecond speed{1};                    ///< [m/s], > 0
    std::optional<Time> arrival = std::nullopt;  ///< instead of a speed; > now

    Step next_leg(Mover& mover) {
        if (mover.position == to && (!arrival || *arrival <= mover.now)) return AtRest{};
        if (arrival && *arrival > mover.now) return straight_leg(mover, to, *arrival);
        return straight_leg(mover, to, speed);
    }
};

}  // namespace rovernet
