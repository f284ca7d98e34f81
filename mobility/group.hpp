// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/draws.hpp"
#include "mobility/intervals.hpp"
#include "mobility/movement.hpp"
#include "mobility/way.hpp"
#include "sim/ids.hpp"

#include <string_view>

namespace rovernet {

/// A member of a group that moves with its leader: the reference point group model.
///
/// Every `every` it heads for the leader's place at the end of the interval (as far as the leader's
/// present leg says) + `offset` + a vector uniform in the disc of `radius`, and arrives then, top
/// speed permitting, around the walls where there are any. If 16 draws find no place that it can
/// reach, it stands for the interval. Its height stays.
/// Source: X. Hong, M. Gerla, G. Pei, C.-C. Chiang, A group mobility model for ad hoc wireless
/// networks, MSWiM 1999.
struct Group {
    static constexpr std::string_view name = "group";

    NodeId leader = {};
    Meters radius{5};                          ///< [m], >= 0, around the reference point
    Duration every = std::chrono::seconds{5};  ///< time from one draw to the next [ns], from 1 us
    Vec3 offset = {};                          ///< [m] of the reference point from the leader

    static constexpr auto fields() {
        return describe(
            field("radius", &Group::radius, non_negative, "of the disc around the reference point"),
            field("every", &Group::every, step_length, "time from one draw to the next"),
            field("offset", &Group::offset, "of the reference point from the leader"));
    }

    /// @throws std::invalid_argument for a parameter out of its range or a leader that is not there
    Step next_leg(Mover& mover);

    /// Left to the model.
    struct Progress {
        Draws draws = {};
        Time arrival = start_of_run;  // the end of the interval
        Way way = {};                 // way until then
    } progress = {};
};

}  // namespace rovernet
