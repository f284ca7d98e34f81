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

// Movements as a scenario file gives them. Models of mobility/ that describe their parameters are
// read as they are; the others (fixed, waypoints, goal) have a table here. MotionBuilder makes a
// Movement of each.
//
//     move = { model = "random_waypoint", area = [["0 m", "0 m"], ["100 m", "50 m"]] }

namespace rovernet {

/// The robot stays where it is. It is the default:
///
///   move = { model = "fixed" }
struct FixedTable {
    static constexpr std::string_view name = "fixed";
    static constexpr auto fields() { return describe(); }
};

/// The robot goes from place to place, around the walls, and then rests:
///
///   move = { model = "waypoints", path = [["5 m", "3 m"], ["5 m", "9 m"]], speed = "1 m/s" }
struct WaypointsTable {
    /// Order of the places: as they are given, or shuffled anew in each replication.
    enum class Order { given, shuffled };
    static constexpr std::string_view name = "waypoints";

    /// Places to go to [m], at least one.
    std::vector<Vec3> path;
    /// Speed on the way [m/s], > 0; of no effect with `times`.
    MetersPerSecond speed{1};
    /// Times at which the robot is at each place of the path [ns], as many as there are places,
    /// each later than the one before; instead of a speed.
    std::optional<std::vector<Duration>> times;
    Order order = Order::given;

    static constexpr auto fields() {
        return describe(
            field("path", &WaypointsTable::path, "places to go to, one after the other"),
            field("speed", &WaypointsTable::speed, positive, "between the places"),
            field("times", &WaypointsTable::times,
                  "when to be at each place of the path, instead of a speed"),
            field("order", &WaypointsTable::order, "given, or shuffled anew in each replication"));
    }
};
/// Words of the order in files.
template <>
struct EnumNames<WaypointsTable::Order> {
    static constexpr std::array<std::string_view, 2> values = {"given", "shuffled"};
};

/// The robot goes to one place, around the walls, and then rests:
///
///   move = { model = "goal", to = ["5 m", "9 m"], speed = "1 m/s" }
struct GoalTable {
    static constexpr std::string_view name = "goal";

    /// Place to go to [m]; either this or `among` is given.
    std::optional<Vec3> to;
    /// Places of which one is drawn in each replication [m].
    std::vector<Vec3> among;
    /// Speed on the way [m/s], > 0.
    MetersPerSecond speed{1};

    static constexpr auto fields() {
        return describe(field("to", &GoalTable::to, "where to go, around the walls"),
                        field("among", &GoalTable::among,
                              "instead of to: one of these, drawn anew in each replication"),
                        field("speed", &GoalTable::speed, positive, "on the way"));
    }
};

/// Movement models that scenario files know by name. A model that is added here is read, checked,
/// printed, documented and swept: all of that follows from its fields().
using MoveModels =
    std::variant<FixedTable, WaypointsTable, GoalTable, Patrol, Follow, Group, RandomWaypoint,
                 RandomDirection, RandomWalk, GaussMarkov, Wander, FollowWall>;

/// Movement model of a robot that goes by another one: its leader, which the file gives by name.
template <class Model>
concept LedModel = requires(Model model) {
    model.leader;
};

/// Movement model that can draw its robot's first place.
template <class Model>
concept DrawnModel = requires(Model model) {
    model.start;
};

/// Movement as a file gives it: one model with its parameters, and its places for errors that are
/// found when it is built.
struct MoveTable {
    /// Chosen model with its parameters.
    MoveModels model;
    /// Name of the robot that a led model goes by; empty for others.
    std::string leader = {};
    /// Places of the table and of its key `leader`.
    Location where = {}, leader_where = {};

    /// Whether the model draws where the robot starts: a [[robot]] needs no `at` then.
    bool draws_place() const;
    /// Name of the model.
    std::string_view name() const {
        return std::visit([](const auto& m) { return std::decay_t<decltype(m)>::name; }, model);
    }
};

/// Reads move = { ... }.
/// @param placed  whether the robot has a place to start from, so that its model draws none
/// @throws InputError for an unknown model or key, a value out of its range, and a parameter that
/// the model cannot do without
MoveTable read_move(const Value& value, bool placed);

/// Table that reads back as the same movement.
Table move_document(const MoveTable& move);

}  // namespace rovernet
