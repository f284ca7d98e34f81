// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "sim/fields.hpp"

#include <cstddef>
#include <string_view>

namespace rovernet {

class LookRound;

/// Obstacle avoidance by a range finder: the robot moves straight ahead until an obstacle is within
/// `keep` of its body, or for the length `run`. Then the robot measures all around, and turns to a
/// random direction with more than 2 `keep` of free space; directions with more free space are more
/// likely. If there is no such direction, the robot turns to the direction with the most free
/// space, a random one among equals.
///
/// The model needs a map. Robots do not detect each other.
struct Wander {
    static constexpr std::string_view name = "wander";
    static constexpr AtDoors at_doors = AtDoors::looks;

    MetersPerSecond speed{0.5};        ///< speed ahead, > 0
    RadiansPerSecond turn_rate{1.57};  ///< turn rate of a turn in place, > 0
    Meters keep{0.5};                  ///< free space kept ahead of the robot's body, > 0
    Meters range{8};  ///< largest distance that the robot's range finder measures, > 0
    Meters run{10};   ///< longest straight path, > 0

    static constexpr auto fields() {
        return describe(
            field("speed", &Wander::speed, positive, "speed while the robot moves straight ahead"),
            field("turn_rate", &Wander::turn_rate, turn_rates,
                  "rate at which the robot turns in place"),
            field("keep", &Wander::keep, positive,
                  "free distance that the robot keeps ahead of its body"),
            field("range", &Wander::range, positive,
                  "longest distance that the robot's range finder measures"),
            field("run", &Wander::run, positive,
                  "longest distance that the robot moves straight ahead before it turns"));
    }

    /// @throws std::invalid_argument for a parameter out of its range, or without a map
    Step next_leg(Mover& mover);

    /// State of the robot in this movement, for the model only.
    struct Progress {
        bool begun = false;
        bool has_turned = true;  // whether the robot has turned since its last straight path
        Draws draws = {};
    } progress = {};

  private:
    /// Angle [rad] by which the robot turns in place to its next direction, counter-clockwise.
    double turn(const Mover& mover);
    // Index of the beam that measures the largest distance; a random one among equals.
    std::size_t farthest(const LookRound& look, const Mover& mover);
};

}  // namespace rovernet
