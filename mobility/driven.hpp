// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "sim/units.hpp"

#include <memory>
#include <optional>

namespace rovernet {

/// Arc of a circle on which a robot moves by velocity commands; consecutive commands share it. The
/// robot moves along chords: straight legs between two points of the arc. The members are the state
/// of the robot on the arc at the start of the current chord. A command during a chord continues
/// from the arc, not from the chord, so that errors of a thousand commands do not add up.
struct DrivenArc {
    Time since = start_of_run;  ///< start of the current straight leg, a chord of the arc
    Vec3 at = {};               ///< position on the arc at `since` [m]
    double heading = 0;         ///< heading at `since` [rad]
    double speed = 0;           ///< speed along the arc [m/s]; 0 if the robot cannot move
    double turn_rate = 0;       ///< turn rate [rad/s], counter-clockwise

    /// Position [m] on the arc at `t` >= since: at + s v (cos b, sin b), with v = speed, the time T
    /// from `since` to `t`, h = T turn_rate / 2, b = heading + h, and s = T sin(h) / h. For h = 0,
    /// s is T.
    Vec3 position(Time t) const;
};

/// Movement by a velocity command: ahead at `speed` while turning at `turn_rate`, until the next
/// command, which is a new movement.
///
/// The ideal path is an arc of a circle. The robot moves along chords, straight lines whose ends
/// lie on the arc, so that errors do not add up. No point of a chord is farther than `chord` from
/// the arc: at 1 m/s and 1 rad/s a chord takes 89 ms. A chord ends where the robot's body meets an
/// obstacle. A robot that touches a wall and heads into the wall turns in place until its heading
/// is along the wall, and then continues on an arc. Without a turn rate this robot stands still.
/// Consecutive commands share one `arc`.
struct Driven {
    static constexpr AtDoors at_doors = AtDoors::drives;

    MetersPerSecond speed{0};        ///< speed ahead, at most the robot's top speed; < 0: backwards
    RadiansPerSecond turn_rate{0};   ///< turn rate, counter-clockwise
    Meters chord{0.001};             ///< largest distance of a straight leg from the arc, > 0
    std::optional<Time> until = {};  ///< end of the command: the robot then stands still
    /// Arc of the previous command, which this command continues; null: the arc starts at the
    /// robot's position.
    std::shared_ptr<DrivenArc> arc = {};

    Step next_leg(Mover& mover);

  private:
    // Leg (piece of movement) straight ahead, as far as is free, for at most `time`. Without free
    // space the result is `leg`, a leg at rest.
    Leg straight_ahead(const Mover& mover, const DrivenArc& ahead, Duration time, Leg leg);
    // Leg (piece of movement) of a robot that moves and turns: a straight chord of the arc for at
    // most `time`. At an obstacle the result is `leg`, a turn in place, with an earlier end.
    Leg along_arc(const Mover& mover, const DrivenArc& ahead, Duration time, Leg leg);
};

}  // namespace rovernet
