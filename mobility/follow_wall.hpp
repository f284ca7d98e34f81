// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "sim/fields.hpp"

#include <array>
#include <string_view>

namespace rovernet {

/// Side of a robot on which it follows its wall.
enum class WallSide { left, right };
/// Names of the values of `side` in scenario files.
template <>
struct EnumNames<WallSide> {
    static constexpr std::array<std::string_view, 2> values = {"left", "right"};
};

/// Movement along walls by a range finder: the robot keeps the nearest wall on its `side` at the
/// distance `keep` from its body, turns at corners and never arrives. In a passage too narrow for
/// this distance the robot stays in the middle. Without a wall on that side within `range`, the
/// robot moves straight ahead until its range finder measures a wall.
///
/// After each `stride` the robot measures again and moves along the wall that is nearest then,
/// corrected by the distance error. There is no error at a straight wall. Around a convex corner
/// the robot moves on short straight lines, at most stride^2 / (8 R) [m] off the circle around the
/// corner with radius R: `keep` plus the radius of its body.
///
/// The model needs a map. Robots do not detect each other.
struct FollowWall {
    static constexpr std::string_view name = "follow_wall";
    static constexpr AtDoors at_doors = AtDoors::looks;

    WallSide side = WallSide::left;
    MetersPerSecond speed{0.5};  ///< speed along the wall, > 0
    Meters keep{0.5};            ///< distance from the robot's body to the wall, > 0
    Meters stride{0.1};          ///< path length between two measurements, > 0
    Meters range{8};             ///< largest distance that the robot's range finder measures, > 0

    static constexpr auto fields() {
        return describe(field("side", &FollowWall::side, "side of the robot on which the wall is"),
                        field("speed", &FollowWall::speed, positive, "speed along the wall"),
                        field("keep", &FollowWall::keep, positive,
                              "distance from the robot's body to the wall"),
                        field("stride", &FollowWall::stride, positive,
                              "distance that the robot moves between two measurements"),
                        field("range", &FollowWall::range, positive,
                              "longest distance that the robot's range finder measures"));
    }

    /// @throws std::invalid_argument for a parameter out of its range, or without a map
    Step next_leg(Mover& mover);

    /// State of the robot in this movement, for the model only.
    struct Progress {
        bool begun = false;
    } progress = {};
};

}  // namespace rovernet
