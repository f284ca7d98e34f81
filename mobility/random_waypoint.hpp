// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/area.hpp"
#include "mobility/intervals.hpp"
#include "mobility/movement.hpp"
#include "mobility/speed_range.hpp"
#include "mobility/way.hpp"
#include "sim/fields.hpp"

#include <array>
#include <string_view>
#include <vector>

namespace rovernet {

/// Start of a random waypoint movement. After the start of the run it is always `here`.
enum class StartState {
    stationary,  ///< state as if it had gone on for ever
    uniform,     ///< place uniform in the area, with a new trip: the mean speed decays
    here,        ///< place where the robot is, with a new trip: the mean speed decays
};
template <>
struct EnumNames<StartState> {
    static constexpr std::array<std::string_view, 3> values = {"stationary", "uniform", "here"};
};

/// Random waypoint movement: to a place uniform in the area, around the walls where there are any,
/// at a speed uniform between the two; then a rest; and again.
///
/// On a map, places are uniform among those where the robot's body has room and to which there is a
/// way; ways may leave the area. Blocked if 200 draws find none. Speeds above the robot's top speed
/// are not drawn.
///
/// Stationary start: a trip is drawn as any other, kept with probability proportional to the time
/// that it and its rest take on average, and met at a uniform moment of that time; while it moves,
/// its speed has density 1/v. Exact on an open field. On a map a way longer than twice the area's
/// diagonal counts as that long. Needs min_speed > 0, as the slowest trips would last for ever.
/// Sources: D. Johnson, D. Maltz, Dynamic source routing in ad hoc wireless networks, 1996; W.
/// Navidi, T. Camp, Stationary distributions for the random waypoint mobility model, IEEE TMC 3(1),
/// 2004; J. Yoon, M. Liu, B. Noble, Random waypoint considered harmful, INFOCOM 2003.
struct RandomWaypoint {
    static constexpr std::string_view name = "random_waypoint";

    std::vector<Vec3> area = {};     ///< [m] lower-left and upper-right; empty: the map
    MetersPerSecond min_speed{0.5};  ///< [m/s], >= 0; > 0 for a stationary start
    MetersPerSecond max_speed{1.5};  ///< [m/s], > 0, >= min_speed
    Duration pause{0};               ///< [ns] rest after each trip
    StartState start = StartState::stationary;

    static constexpr auto fields() {
        return describe(
            field("area", &RandomWaypoint::area,
                  "lower-left and upper-right corner; the whole map if not given"),
            field("min_speed", &RandomWaypoint::min_speed, non_negative,
                  "of a trip; > 0 for a stationary start"),
            field("max_speed", &RandomWaypoint::max_speed, positive, "of a trip"),
            field("pause", &RandomWaypoint::pause, rest_length, "after each trip"),
            field("start", &RandomWaypoint::start,
                  "stationary; or with a new trip: from a uniform place, or from here"));
    }

    /// Left to the model: what it remembers of one robot.
    struct Progress {
        bool begun = false;
        bool rested = true;  // since the last trip
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
