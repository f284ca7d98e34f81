// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "sim/units.hpp"

#include <optional>

namespace rovernet {

/// A robot that is driven by a velocity command: ahead at `speed` while it turns at `turn_rate`,
/// until the next command, which is another movement.
///
/// Its way is an arc, made of chords whose ends lie on it, so that nothing drifts. No point of a
/// chord is farther than `chord` from the arc: at 1 m/s and 1 rad/s a chord takes 89 ms. A chord
/// goes only as far as the robot's body can; then the robot turns in place, or stands still if the
/// command does not turn.
struct Driven {
    MetersPerSecond speed{0};        ///< ahead; < 0: backwards. At most the robot's top speed
    RadiansPerSecond turn_rate{0};   ///< counter-clockwise
    Meters chord{0.001};             ///< > 0
    std::optional<Time> until = {};  ///< end of the command: then the robot stands still

    Step next_leg(Mover& mover);
};

}  // namespace rovernet
