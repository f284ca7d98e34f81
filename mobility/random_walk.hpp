// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/area.hpp"
#include "mobility/movement.hpp"
#include "sim/fields.hpp"

#include <string_view>
#include <vector>

namespace rovernet {

struct SpeedRange;

/// Random walk mobility model. After every `step` the robot draws a uniform random direction and a
/// uniform random speed between min_speed and max_speed. The borders of the area reflect the robot.
///
/// On an open field, from a uniform start, positions and speeds are uniformly distributed at all
/// times. At a wall or the map's border the step ends a micrometre before it, and the next step
/// begins. Speeds above the robot's top speed are not drawn.
/// Source: T. Camp, J. Boleng, V. Davies, A survey of mobility models for ad hoc network research,
/// Wireless Communications and Mobile Computing 2(5), 2002, section 2.1.
struct RandomWalk {
    static constexpr std::string_view name = "random_walk";
    static constexpr AtDoors at_doors = AtDoors::looks;

    std::vector<Vec3> area = {};     ///< area [m]: lower-left, upper-right corner; empty: the map
    MetersPerSecond min_speed{0.5};  ///< lowest speed [m/s], >= 0
    MetersPerSecond max_speed{1.5};  ///< highest speed [m/s], > 0, >= min_speed
    Duration step = std::chrono::seconds{10};  ///< time between two draws [ns], from 1 us
    StartPlace start = StartPlace::uniform;

    static constexpr auto fields() {
        return describe(
            field("area", &RandomWalk::area,
                  "lower-left and upper-right corner of the area in which the robot moves; if not "
                  "given, the whole map"),
            field("min_speed", &RandomWalk::min_speed, non_negative, "smallest speed of a step"),
            field("max_speed", &RandomWalk::max_speed, positive, "largest speed of a step"),
            field("step", &RandomWalk::step, step_length,
                  "time between two changes of speed and direction"),
            field("start", &RandomWalk::start,
                  "place at which the movement begins. uniform: a place drawn uniformly from the "
                  "area; here: the robot's `at` or `place`"));
    }

    /// @throws std::invalid_argument for a parameter out of its range
    Step next_leg(Mover& mover);

    /// State of the robot in this movement, for the model only.
    struct Progress {
        bool begun = false;
        Draws draws = {};
        Time step_end = start_of_run;
        Vec3 direction = {};  // unit vector
        MetersPerSecond speed = {};
    } progress = {};

  private:
    void begin_step(const Mover& mover, const SpeedRange& speeds);
};

}  // namespace rovernet
