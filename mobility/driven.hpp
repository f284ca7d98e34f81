// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "sim/units.hpp"

#include <memory>
#include <optional>

namespace rovernet {

/// Arc on which a driven robot is, for whoever drives it: each chord writes down where it begins.
/// A command in the midst of a chord goes on from the arc, not from the chord, so that a thousand
/// commands are no farther off than one.
struct DrivenArc {
    Time since = start_of_run;  ///< begin of the chord
    Vec3 at = {};               ///< place on the arc then [m]
    double heading = 0;         ///< heading then [rad]
    double speed = 0;           ///< [m/s]; 0 where the robot cannot go on
    double turn_rate = 0;       ///< [rad/s]

    /// Place on the arc at `t` >= since [m]:  at + s v (cos b, sin b)  with  b = heading + w t / 2
    /// and s = t sin(w t / 2) / (w t / 2), which is exact for w = 0, too.
    Vec3 position(Time t) const;
};

/// A robot that is driven by a velocity command: ahead at `speed` while it turns at `turn_rate`,
/// until the next command, which is another movement.
///
/// Its way is an arc, made of chords whose ends lie on it, so that nothing drifts. No point of a
/// chord is farther than `chord` from the arc: at 1 m/s and 1 rad/s a chord takes 89 ms. A chord
/// goes only as far as the robot's body can. A robot that touches a wall and heads into it turns in
/// place until it heads along the wall, and then leaves it on an arc; if the command does not turn
/// it stands still. A command that follows another one shares its `arc`.
struct Driven {
    static constexpr AtDoors at_doors = AtDoors::drives;

    MetersPerSecond speed{0};        ///< ahead; < 0: backwards. At most the robot's top speed
    RadiansPerSecond turn_rate{0};   ///< counter-clockwise
    Meters chord{0.001};             ///< > 0
    std::optional<Time> until = {};  ///< end of the command: then the robot stands still
    /// Arc of the command before, which this one takes over; null: it begins where the robot is.
    std::shared_ptr<DrivenArc> arc = {};

    Step next_leg(Mover& mover);

  private:
    // Leg of a robot that does not turn: as far ahead as it can, in `time` at most. `leg`: it
    // stands.
    Leg straight_ahead(const Mover& mover, const DrivenArc& ahead, Duration time, Leg leg);
    // Leg of a robot that turns: on a chord of `time` at most, or held by what it touches. `leg`:
    // it turns in place until the command ends.
    Leg along_arc(const Mover& mover, const DrivenArc& ahead, Duration time, Leg leg);
};

}  // namespace rovernet
