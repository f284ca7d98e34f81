// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/area.hpp"
#include "mobility/movement.hpp"
#include "sim/fields.hpp"

#include <array>
#include <string_view>
#include <vector>

namespace rovernet {

struct SpeedRange;

/// Distribution of the direction in which a robot leaves a border.
enum class BorderTurn {
    cosine,   ///< density cos of the angle to the border's normal (Lambert's law)
    uniform,  ///< all angles equally likely
};
/// Names of the values of `border_turn` in scenario files.
template <>
struct EnumNames<BorderTurn> {
    static constexpr std::array<std::string_view, 2> values = {"cosine", "uniform"};
};

/// Random direction mobility model: the robot moves in a random direction to the border of the area
/// or a wall, at a uniform random speed between min_speed and max_speed, rests, and repeats.
///
/// The model is stationary from a uniform start if border_turn = cosine, the field is open, there
/// is no pause, and min_speed > 0: the density of positions is then uniform at all times. For this
/// purpose the first speed v is drawn with a density proportional to 1/v. With border_turn =
/// uniform, the rule of the source, the density of positions is higher along the borders. The robot
/// stops a micrometre before a wall and leaves it at a uniform angle. Speeds above the robot's top
/// speed are not drawn.
/// Source: E. Royer, P. Melliar-Smith, L. Moser, An analysis of the optimum node density for ad hoc
/// mobile networks, ICC 2001.
struct RandomDirection {
    static constexpr std::string_view name = "random_direction";
    static constexpr AtDoors at_doors = AtDoors::looks;

    std::vector<Vec3> area = {};     ///< area [m]: lower-left, upper-right corner; empty: the map
    MetersPerSecond min_speed{0.5};  ///< lowest speed [m/s], >= 0
    MetersPerSecond max_speed{1.5};  ///< highest speed [m/s], > 0, >= min_speed
    Duration pause{0};               ///< rest at each border or wall [ns]
    BorderTurn border_turn = BorderTurn::cosine;
    StartPlace start = StartPlace::uniform;

    static constexpr auto fields() {
        return describe(
            field("area", &RandomDirection::area,
                  "lower-left and upper-right corner of the area in which the robot moves; if not "
                  "given, the whole map"),
            field("min_speed", &RandomDirection::min_speed, non_negative,
                  "smallest speed of a straight trip"),
            field("max_speed", &RandomDirection::max_speed, positive,
                  "largest speed of a straight trip"),
            field("pause", &RandomDirection::pause, rest_length, "rest after each straight trip"),
            field(
                "border_turn", &RandomDirection::border_turn,
                "distribution of the angle between the new direction and the normal of the border"),
            field("start", &RandomDirection::start,
                  "place at which the movement begins. uniform: a place drawn uniformly from the "
                  "area; here: the robot's `at` or `place`"));
    }

    /// @throws std::invalid_argument for a parameter out of its range
    Step next_leg(Mover& mover);

    /// State of the robot in this movement, for the model only.
    struct Progress {
        bool begun = false;
        bool rested = true;  // whether the robot has rested since its last leg
        Draws draws = {};
    } progress = {};

  private:
    Vec3 new_direction(const Mover& mover, const Area& field);
};

}  // namespace rovernet
