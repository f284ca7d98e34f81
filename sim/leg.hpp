// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"
#include "sim/time.hpp"

#include <algorithm>
#include <cmath>

namespace rovernet {

/// Straight piece of a robot's motion: position(t) = from + velocity * (t - start), from `start` to
/// `end`.
///
/// A movement model returns the next leg when the current one ends. A leg either moves or turns: a
/// robot turns only at rest.
struct Leg {
    /// Start of the leg.
    Time start = start_of_run;
    /// End of the leg, at which the movement model returns the next leg; `never` if the leg lasts
    /// until it is replaced.
    Time end = never;
    /// Position at `start` [m].
    Vec3 from = {};
    /// Velocity [m/s]; zero while the robot turns or rests.
    Vec3 velocity = {};
    /// Position at `end` [m], equal to `from` for a leg at rest. The position is stored, so that
    /// rounding in position() never makes a robot miss its goal.
    Vec3 to = {};
    /// Heading at `start` [rad], counter-clockwise from the x axis.
    double heading = 0;
    /// Turn rate [rad/s], counter-clockwise.
    double turning = 0;

    /// Position at `t` >= start [m]; equal to `to` from `end` on.
    Vec3 position(Time t) const {
        if (t >= end) return to;
        return from + seconds(t - start) * velocity;
    }
    /// Heading at `t` >= start [rad]; constant from `end` on. The heading is not wrapped to -pi ...
    /// pi: turns add up, so that an animation shows the direction of a turn.
    double heading_at(Time t) const {
        return turning == 0 ? heading : heading + seconds(std::min(t, end) - start) * turning;
    }
};

/// Heading [rad] wrapped to -pi ... pi.
inline double wrapped(double heading) {
    return std::abs(heading) < 3.141592653589793 ? heading
                                                 : std::remainder(heading, 6.283185307179586);
}

}  // namespace rovernet
