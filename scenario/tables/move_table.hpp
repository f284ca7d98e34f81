// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/follow.hpp"
#include "mobility/follow_wall.hpp"
#include "mobility/gauss_markov.hpp"
#include "mobility/group.hpp"
#include "mobility/patrol.hpp"
#include "mobility/random_direction.hpp"
#include "mobility/random_walk.hpp"
#include "mobility/random_waypoint.hpp"
#include "mobility/wander.hpp"
#include "scenario/document/value.hpp"
#include "sim/error.hpp"
#include "sim/fields.hpp"
#include "sim/geometry.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

// Movements in a scenario file. Models of mobility/ that describe their parameters are read
// directly; the models fixed, waypoints and goal have a table here. MotionBuilder makes a Movement
// of each table.
//
//     move = { model = "random_waypoint", area = [["0 m", "0 m"], ["100 m", "50 m"]] }

namespace rovernet {

/// Movement `fixed`, the default: the robot stays at its start position:
///
///   move = { model = "fixed" }
struct FixedTable {
    static constexpr std::string_view name = "fixed";
    static constexpr auto fields() { return describe(); }
};

/// Movement `waypoints`: the robot visits points in turn, around the walls, and then rests:
///
///   move = { model = "waypoints", path = [["5 m", "3 m"], ["5 m", "9 m"]], speed = "1 m/s" }
struct WaypointsTable {
    /// Order in which the robot visits the points: as given, or shuffled in each replication.
    enum class Order { given, shuffled };
    static constexpr std::string_view name = "waypoints";

    /// Points to visit [m], at least one.
    std::vector<Vec3> path;
    /// Speed between points [m/s], > 0; ignored with `times`.
    MetersPerSecond speed{1};
    /// Arrival time at each point of `path` [ns], in increasing order, one for each point; instead
    /// of a speed.
    std::optional<std::vector<Duration>> times;
    Order order = Order::given;

    static constexpr auto fields() {
        return describe(
            field("path", &WaypointsTable::path, "places to go to, one after the other"),
            field("speed", &WaypointsTable::speed, positive, "speed between the places"),
            field("times", &WaypointsTable::times,
                  "instead of `speed`: one time for each place of the path, at which the robot is "
                  "there"),
            field("order", &WaypointsTable::order,
                  "order of the places. given: the order of `path`; shuffled: a random order, "
                  "drawn anew in each replication"));
    }
};
/// Names of WaypointsTable::Order in scenario files.
template <>
struct EnumNames<WaypointsTable::Order> {
    static constexpr std::array<std::string_view, 2> values = {"given", "shuffled"};
};

/// Movement `goal`: the robot drives to one point, around the walls, and then rests:
///
///   move = { model = "goal", to = ["5 m", "9 m"], speed = "1 m/s" }
struct GoalTable {
    static constexpr std::string_view name = "goal";

    /// Point to which the robot drives [m]; either `to` or `among` is given.
    std::optional<Vec3> to;
    /// Possible goals [m], of which one is drawn in each replication. Given instead of `to`.
    std::vector<Vec3> among;
    /// Speed of the robot [m/s], > 0.
    MetersPerSecond speed{1};

    static constexpr auto fields() {
        return describe(
            field("to", &GoalTable::to, "place to which the robot goes, around the walls"),
            field("among", &GoalTable::among,
                  "instead of `to`: places, one of which is drawn as the goal in each replication"),
            field("speed", &GoalTable::speed, positive, "speed on the way to the goal"));
    }
};

/// Movement models that scenario files can name. A model that is added to this list is read,
/// checked, printed, documented and swept by its fields(), without further code.
using MoveModels =
    std::variant<FixedTable, WaypointsTable, GoalTable, Patrol, Follow, Group, RandomWaypoint,
                 RandomDirection, RandomWalk, GaussMarkov, Wander, FollowWall>;

/// Concept of a movement model whose robot follows a leader; the scenario file names the leader.
template <class Model>
concept LedModel = requires(Model model) {
    model.leader;
};

/// Concept of a movement model that can draw the start position of its robot.
template <class Model>
concept DrawnModel = requires(Model model) {
    model.start;
};

/// Movement in a scenario file: one model with its parameters, and file positions for errors that
/// are found when the Movement is built.
struct MoveTable {
    /// Chosen model with its parameters.
    MoveModels model;
    /// Name of the robot to follow, for a LedModel; empty for other models.
    std::string leader = {};
    /// File positions of the `move` table and of its key `leader`.
    Location where = {}, leader_where = {};

    /// Whether the model draws the start position, so that the [[robot]] needs no `at`.
    bool draws_place() const;
    /// Name of the movement model.
    std::string_view name() const {
        return std::visit([](const auto& m) { return std::decay_t<decltype(m)>::name; }, model);
    }
};

/// Names of all models of the list MoveModels, in order.
std::vector<std::string> move_names();

/// Reads the movement of a robot: move = { ... }.
/// @param placed  true if the robot has a start position, so that its model draws none
/// @throws InputError for an unknown model or key, a value out of range, or a missing required
/// parameter
MoveTable read_move(const Value& value, bool placed);

/// Converts a movement to a `move` table: the inverse of read_move().
Table move_document(const MoveTable& move);

}  // namespace rovernet
