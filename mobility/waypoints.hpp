// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "mobility/way.hpp"

#include <cstddef>
#include <vector>

namespace rovernet {

/// A place and the time to be there.
struct TimedPoint {
    Time time;
    Vec3 position;  ///< [m]

    TimedPoint(Duration t, Vec3 p) : time(start_of_run + t), position(p) {}
};

/// Movement from place to place, around the walls where there are any: by timetable (`timed`), then
/// along `path` at `speed`. Two places on different storeys are the ends of stairs: the way between
/// them is straight. Speeds and lengths are those in space.
///
/// Between two timed places the speed is constant. A timed place whose time has passed when its
/// turn comes is left out.
struct Waypoints {
    std::vector<TimedPoint> timed = {};
    std::vector<Vec3> path = {};  ///< [m]
    MetersPerSecond speed{1};     ///< [m/s], > 0; for `path`

    /// @throws std::invalid_argument unless speed > 0 and the places are finite
    Step next_leg(Mover& mover);

    /// Progress of the robot in its lists; left to the model.
    struct Progress {
        std::size_t places = 0;  // places of both lists, taken up so far
        Way way = {};            // way to the last of them
    } progress = {};
};

/// Movement to one place, around the walls.
struct ToGoal {
    Vec3 to;                   ///< [m]
    MetersPerSecond speed{1};  ///< [m/s], > 0

    operator Movement() const { return Waypoints{.path = {to}, .speed = speed}; }
};

}  // namespace rovernet
