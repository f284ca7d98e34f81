// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/intervals.hpp"
#include "mobility/movement.hpp"
#include "sim/ids.hpp"

#include <string_view>

namespace rovernet {

/// Keeps behind another robot: every `every` it looks where the leader is and goes along the way
/// there, around the walls, until `distance` is left of it.
///
/// It spreads what it has to go over the interval, at `speed` at most, and stands while the leader
/// is nearer. Behind a leader of constant speed v < `speed` on a straight line, it is
/// `distance` + v `every` away at each look. While there is no way it stands and looks again. Its
/// height stays.
struct Follow {
    static constexpr std::string_view name = "follow";
    static constexpr AtDoors at_doors = AtDoors::looks;

    NodeId leader = {};
    Meters distance{2};                        ///< [m], >= 0, along the way
    MetersPerSecond speed{1};                  ///< [m/s], > 0, at most
    Duration every = std::chrono::seconds{1};  ///< [ns], from 1 us

    static constexpr auto fields() {
        return describe(
            field("distance", &Follow::distance, non_negative, "kept to the leader, along the way"),
            field("speed", &Follow::speed, positive, "at most"),
            field("every", &Follow::every, step_length, "time from one look to the next"));
    }

    /// @throws std::invalid_argument for a parameter out of its range or a leader that is not there
    Step next_leg(Mover& mover);
};

}  // namespace rovernet
