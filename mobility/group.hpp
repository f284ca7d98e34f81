// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "mobility/way.hpp"
#include "sim/ids.hpp"

#include <string_view>

namespace rovernet {

/// Reference point group mobility model: a member of a group that moves with its leader.
///
/// At intervals of `every`, the member gets a new goal: the leader's position at the end of the
/// interval (predicted by the leader's current leg) + `offset` + a uniform random vector in the
/// disc of `radius`. The member arrives at the end of the interval if its top speed allows, around
/// the walls if there are any. If 16 draws find no reachable goal, the member stands for the
/// interval. The height of the member is constant.
/// Source: X. Hong, M. Gerla, G. Pei, C.-C. Chiang, A group mobility model for ad hoc wireless
/// networks, MSWiM 1999.
struct Group {
    static constexpr std::string_view name = "group";

    NodeId leader = {};
    Meters radius{5};  ///< radius of the disc around the reference point [m], >= 0
    Duration every = std::chrono::seconds{5};  ///< time from one draw to the next [ns], from 1 us
    Vec3 offset = {};  ///< vector from the leader to the reference point [m]

    static constexpr auto fields() {
        return describe(
            field("radius", &Group::radius, non_negative,
                  "radius of the disc in which the robot's goals are drawn"),
            field("every", &Group::every, step_length,
                  "time between two draws of a new goal in the disc"),
            field("offset", &Group::offset, "vector from the leader to the centre of the disc"));
    }

    /// @throws std::invalid_argument for a parameter out of its range or an unknown leader
    Step next_leg(Mover& mover);

    /// State of the robot in this movement, for the model only.
    struct Progress {
        Draws draws = {};
        Time arrival = start_of_run;  // end of the interval
        Way way = {};                 // path followed until `arrival`
    } progress = {};
};

}  // namespace rovernet
