// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/propagation_table.hpp"
#include "models/radio.hpp"
#include "sim/error.hpp"
#include "sim/fields.hpp"
#include "sim/geometry.hpp"

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace rovernet {

/// move = { model = "waypoints", ... }
struct WaypointsTable {
    enum class Order { given, shuffled };

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

/// move = { model = "fixed" }
struct FixedTable {
    static constexpr auto fields() { return describe(); }
};

/// A movement as a file gives it, and where, for errors found when it is built.
struct MoveTable {
    std::variant<FixedTable, WaypointsTable, GoalTable> model;
    Location where;
};
inline constexpr std::array<std::string_view, 3> move_models = {"fixed", "waypoints", "goal"};

/// place = { ... }: a start that is drawn anew in each replication.
struct PlaceTable {
    enum class Model { uniform, choice };

    Model model = Model::uniform;
    std::vector<Vec3> area;    ///< [m] uniform: lower-left and upper-right corner
    std::vector<Vec3> points;  ///< [m] choice: one of these
    Location where = {};

    static constexpr auto fields() {
        return describe(
            field("model", &PlaceTable::model, "uniform in an area, or a choice of points"),
            field("area", &PlaceTable::area, "uniform: lower-left and upper-right corner"),
            field("points", &PlaceTable::points, "choice: one of these places"));
    }
};
template <>
struct EnumNames<PlaceTable::Model> {
    static constexpr std::array<std::string_view, 2> values = {"uniform", "choice"};
};

/// on_receive = { ... }
struct OnReceiveTable {
    std::string payload;  ///< what the message must begin with
    bool once = true;
    std::optional<MoveTable> move;
};

/// [[robot]], one or `count` of a kind.
struct RobotTable {
    std::string name;
    std::optional<int> count;  ///< robots name0, name1, ...
    std::optional<Vec3> at;    ///< [m]
    std::optional<PlaceTable> place;
    Meters radius{0.2};
    Radio radio;  ///< [radio] with the robot's own keys over it
    std::optional<PropagationTable> propagation;
    MoveTable move;
    std::optional<OnReceiveTable> on_receive;
    std::vector<Duration> off, on;  ///< when the robot is switched off and on
    Location where, at_where, radio_where, propagation_where;
};

}  // namespace rovernet
