// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "sim/units.hpp"

#include <memory>
#include <optional>

namespace rovernet {

/// Arc of a circle on which a robot moves by velocity commands, shared by consecutive commands. The
/// robot's legs are chords of the arc; each chord stores its start here. A command during a chord
/// continues from the arc, not from the chord, so that errors of a thousand commands do not add up.
struct DrivenArc {
    Time since = start_of_run;  ///< time at which the current chord starts
    Vec3 at = {};               ///< position on the arc at `since` [m]
    double heading = 0;         ///< heading at `since` [rad]
    double speed = 0;           ///< speed along the arc [m/s]; 0 if the robot cannot move
    double turn_rate = 0;       ///< turn rate [rad/s], counter-clockwise

    /// Position on the arc at `t` >= since [m]:  at + s v (cos b, sin b)  with  b = heading + w t /
    /// 2 and s = t sin(w t / 2) / (w t / 2), which is also exact for w = 0.
    Vec3 position(Time t) const;
};

/// Movement by a velocity command: ahead at `speed` while turning at `turn_rate`, until the next
/// command, which is a new movement.
///
/// The path is an arc, made of chords whose ends lie on it, so there is no drift. No point of a
/// chord is farther than `chord` from the arc: at 1 m/s and 1 rad/s a chord takes 89 ms. A chord
/// ends where the robot's body meets an obstacle. A robot that touches a wall and heads into it
/// turns in place until it heads along the wall, and then continues on an arc; without a turn rate
/// it stands still. Consecutive commands share one `arc`.
struct Driven {
    static constexpr AtDoors at_doors = AtDoors::drives;

    MetersPerSecond speed{0};        ///< speed ahead, at most the robot's top speed; < 0: backwards
    RadiansPerSecond turn_rate{0};   ///< turn rate, counter-clockwise
    Meters chord{0.001};             ///< largest distance between the arc and its chords, > 0
    std::optional<Time> until = {};  ///< end of the command: the robot then stands still
    /// Arc of the previous command, which this command continues; null: the arc starts at the
    /// robot's position.
    std::shared_ptr<DrivenArc> arc = {};

    Step next_leg(Mover& mover);

  private:
    // Leg (piece of movement) straight ahead, as far as is free, for at most `time`. Without free
    // space the result is `leg`, a leg at rest.
    Leg straight_ahead(const Mover& mover, const DrivenArc& ahead, Duration time, Leg leg);
    // Leg (piece of movement) of a robot that turns: a chord of the arc for at most `time`. At an
    // obstacle the result is `leg`, which turns in place, shortened.
    Leg along_arc(const Mover& mover, const DrivenArc& ahead, Duration time, Leg leg);
};

}  // namespace rovernet
