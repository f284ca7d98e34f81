// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/follow.hpp"
#include "mobility/gauss_markov.hpp"
#include "mobility/group.hpp"
#include "mobility/patrol.hpp"
#include "mobility/random_direction.hpp"
#include "mobility/random_walk.hpp"
#include "mobility/random_waypoint.hpp"
#include "scenario/value.hpp"
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

namespace rovernet {

/// move = { model = "fixed" }
struct FixedTable {
    static constexpr std::string_view name = "fixed";
    static constexpr auto fields() { return describe(); }
};

/// move = { model = "waypoints", ... }
struct WaypointsTable {
    enum class Order { given, shuffled };
    static constexpr std::string_view name = "waypoints";

    std::vector<Vec3> path;  ///< [m]
    MetersPerSecond speed{1};
    std::optional<std::vector<Duration>> times;  ///< one per point of the path; instead of speed
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
template <>
struct EnumNames<WaypointsTable::Order> {
    static constexpr std::array<std::string_view, 2> values = {"given", "shuffled"};
};

/// move = { model = "goal", ... }
struct GoalTable {
    static constexpr std::string_view name = "goal";

    std::optional<Vec3> to;   ///< [m]
    std::vector<Vec3> among;  ///< [m] one of them is drawn in each replication, instead of `to`
    MetersPerSecond speed{1};

    static constexpr auto fields() {
        return describe(field("to", &GoalTable::to, "where to go, around the walls"),
                        field("among", &GoalTable::among,
                              "instead of to: one of these, drawn anew in each replication"),
                        field("speed", &GoalTable::speed, positive, "on the way"));
    }
};

/// The movement models that scenario files know by name.
using MoveModels = std::variant<FixedTable, WaypointsTable, GoalTable, Patrol, Follow, Group,
                                RandomWaypoint, RandomDirection, RandomWalk, GaussMarkov>;

/// A model that goes by another robot.
template <class Model>
concept LedModel = requires(Model model) {
    model.leader;
};

/// A model that can draw its robot's first place.
template <class Model>
concept DrawnModel = requires(Model model) {
    model.start;
};

/// A movement as a file gives it, and where, for errors found when it is built.
struct MoveTable {
    MoveModels model;
    std::string leader = {};  ///< name of the robot that a led model goes by
    Location where = {}, leader_where = {};

    /// The model draws where the robot starts.
    bool draws_place() const;
    std::string_view name() const {
        return std::visit([](const auto& m) { return std::decay_t<decltype(m)>::name; }, model);
    }
};

/// Reads move = { ... }. @param placed  the robot has a place to start from
MoveTable read_move(const Value& value, bool placed);

/// The reverse.
Table move_document(const MoveTable& move);

}  // namespace rovernet
