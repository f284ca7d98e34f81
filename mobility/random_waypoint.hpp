// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/area.hpp"
#include "mobility/movement.hpp"
#include "mobility/way.hpp"
#include "sim/fields.hpp"

#include <array>
#include <string_view>
#include <vector>

namespace rovernet {

struct SpeedRange;

/// Initial state of a robot in the random waypoint mobility model, if the movement begins at the
/// start of the run. A movement that begins later always starts as with `here`.
enum class StartState {
    stationary,  ///< drawn from the stationary distribution, as after an infinite time
    uniform,     ///< new trip from a uniform random position; the mean speed falls with time
    here,        ///< new trip from the robot's position; the mean speed falls with time
};
/// Names of the values of `start` in scenario files.
template <>
struct EnumNames<StartState> {
    static constexpr std::array<std::string_view, 3> values = {"stationary", "uniform", "here"};
};

/// Random waypoint mobility model: trips to uniform random positions in the area, around the walls
/// if there are any, at a uniform random speed between min_speed and max_speed, each followed by a
/// rest.
///
/// On a map, goals are uniform among the positions where the robot's body fits and to which there
/// is a path; paths may leave the area. The model returns Blocked if 200 draws find no goal. Speeds
/// above the robot's top speed are not drawn.
///
/// Stationary start: a trip is drawn like any other, accepted with probability proportional to the
/// mean duration of trip and rest, and started at a uniform random time within it. While the robot
/// moves, the density of its speed v is proportional to 1/v. The start is exactly stationary on an
/// open field. On a map, a path longer than twice the area's diagonal counts as twice the diagonal.
/// A stationary start needs min_speed > 0, because the slowest trips would last for ever.
/// Sources: D. Johnson, D. Maltz, Dynamic source routing in ad hoc wireless networks, 1996; W.
/// Navidi, T. Camp, Stationary distributions for the random waypoint mobility model, IEEE TMC 3(1),
/// 2004; J. Yoon, M. Liu, B. Noble, Random waypoint considered harmful, INFOCOM 2003.
struct RandomWaypoint {
    static constexpr std::string_view name = "random_waypoint";

    std::vector<Vec3> area = {};     ///< area [m]: lower-left, upper-right corner; empty: the map
    MetersPerSecond min_speed{0.5};  ///< lowest speed [m/s], >= 0; > 0 for a stationary start
    MetersPerSecond max_speed{1.5};  ///< highest speed [m/s], > 0, >= min_speed
    Duration pause{0};               ///< rest after each trip [ns]
    StartState start = StartState::stationary;

    static constexpr auto fields() {
        return describe(
            field("area", &RandomWaypoint::area,
                  "lower-left and upper-right corner of the area in which the robot moves; if not "
                  "given, the whole map"),
            field("min_speed", &RandomWaypoint::min_speed, non_negative,
                  "smallest speed of a trip; must be > 0 for a stationary start"),
            field("max_speed", &RandomWaypoint::max_speed, positive, "largest speed of a trip"),
            field("pause", &RandomWaypoint::pause, rest_length, "rest after each trip"),
            field(
                "start", &RandomWaypoint::start,
                "how the movement begins. stationary: with place, speed and rest as they are "
                "distributed after a long time; uniform: with a new trip from a place drawn "
                "uniformly from the area; here: with a new trip from the robot's `at` or `place`"));
    }

    /// State of one robot in this movement, for the model only.
    struct Progress {
        bool begun = false;
        bool rested = true;  // whether the robot has rested since its last trip
        Draws draws = {};
        Way way = {};
    } progress = {};

    /// @throws std::invalid_argument for a parameter out of its range
    Step next_leg(Mover& mover) { return next_leg(mover, progress); }
    Step next_leg(Mover& mover, Progress& robot) const;

  private:
    static Step stationary_start(const Mover& mover, const Area& field, const SpeedRange& speeds,
                                 Duration pause, Progress& robot);
    static Step new_trip(Mover& mover, const Area& field, const SpeedRange& speeds,
                         Progress& robot);
};

}  // namespace rovernet
