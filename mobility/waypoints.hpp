// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "mobility/way.hpp"

#include <cstddef>
#include <vector>

namespace rovernet {

/// Position at which a robot arrives at a given time.
struct TimedPoint {
    Time time;
    Vec3 position;  ///< position [m]

    TimedPoint(Duration t, Vec3 p) : time(start_of_run + t), position(p) {}
};

/// Movement from place to place, around the walls if there are any: first by a timetable (`timed`),
/// then along `path` at `speed`. Two consecutive places on different storeys are connected by
/// stairs: a straight path. Speeds and lengths are three-dimensional.
///
/// Between two timed places the speed is constant. A timed place whose time has already passed is
/// skipped.
/// Example: examples/hello.cpp.
struct Waypoints {
    std::vector<TimedPoint> timed = {};
    std::vector<Vec3> path = {};  ///< positions to visit in order [m]
    MetersPerSecond speed{1};     ///< speed along `path` [m/s], > 0

    /// @throws std::invalid_argument unless speed > 0 and all positions are finite
    Step next_leg(Mover& mover);

    /// State of the robot in this movement, for the model only.
    struct Progress {
        std::size_t places = 0;  // number of places of `timed` and `path` headed for so far
        Way way = {};            // path to the last started place
    } progress = {};
};

/// Movement to one position, around the walls.
struct ToGoal {
    Vec3 to;                   ///< goal [m]
    MetersPerSecond speed{1};  ///< speed [m/s], > 0

    operator Movement() const { return Waypoints{.path = {to}, .speed = speed}; }
};

}  // namespace rovernet
