// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "sim/fields.hpp"

#include <array>
#include <string_view>

namespace rovernet {

/// Side on which a robot has its wall.
enum class WallSide { left, right };
template <>
struct EnumNames<WallSide> {
    static constexpr std::array<std::string_view, 2> values = {"left", "right"};
};

/// A robot that goes along the walls, by what its range finder measures: it has the nearest wall of
/// its `side` there, `keep` away from its body, goes round corners and never arrives. Where the way
/// is too narrow for that it keeps to the middle. A robot that has no wall on that side within
/// `range` goes straight ahead until it has.
///
/// Each `stride` it looks again and goes along the wall that is nearest then, corrected by the
/// error of the distance. On a straight wall there is no error; round a corner that points at it
/// the robot goes on chords, at most stride^2 / (8 (keep + radius)) off the circle.
///
/// It needs a map. Robots do not see one another.
struct FollowWall {
    static constexpr std::string_view name = "follow_wall";
    static constexpr AtDoors at_doors = AtDoors::looks;

    WallSide side = WallSide::left;
    MetersPerSecond speed{0.5};  ///< > 0
    Meters keep{0.5};            ///< from its body to the wall, > 0
    Meters stride{0.1};          ///< way between two looks, > 0
    Meters range{8};             ///< farthest that its range finder measures, > 0

    static constexpr auto fields() {
        return describe(field("side", &FollowWall::side, "side on which it has the wall"),
                        field("speed", &FollowWall::speed, positive, "along the wall"),
                        field("keep", &FollowWall::keep, positive, "from its body to the wall"),
                        field("stride", &FollowWall::stride, positive, "way between two looks"),
                        field("range", &FollowWall::range, positive,
                              "farthest that its range finder measures"));
    }

    /// @throws std::invalid_argument for a parameter out of its range, or without a map
    Step next_leg(Mover& mover);

    /// Left to the model.
    struct Progress {
        bool begun = false;
    } progress = {};
};

}  // namespace rovernet
