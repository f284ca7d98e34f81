// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/reader.hpp"
#include "experiment/value.hpp"
#include "models/list.hpp"
#include "models/propagation.hpp"
#include "models/radio.hpp"
#include "routing/flood.hpp"
#include "sim/fields.hpp"
#include "sim/geometry.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

// A scenario file as plain structs: every table and key has one struct and field of the same name.

namespace rovernet {

/// [scenario]
struct ScenarioTable {
    std::string name = "run";
    Duration duration = std::chrono::seconds{60};
    std::uint64_t seed = 1;
    std::uint64_t replication = 0;
    std::uint64_t event_limit = 100'000'000;

    static constexpr auto fields() {
        constexpr Range thirty_two_bits{
            .low = 0, .high = 4294967295, .text = "from 0 to 4294967295"};
        return describe(field("name", &ScenarioTable::name, "of the run and its output folder"),
                        field("duration", &ScenarioTable::duration, positive, "simulated time"),
                        field("seed", &ScenarioTable::seed, "of every random draw"),
                        field("replication", &ScenarioTable::replication, thirty_two_bits,
                              "which of the independent repetitions of the scenario"),
                        field("event_limit", &ScenarioTable::event_limit, positive,
                              "a run that needs more events fails"));
    }
};

/// [scene]
struct SceneTable {
    std::optional<std::string> map;           ///< ROS map.yaml, or a picture with a `size`
    std::optional<std::vector<Meters>> size;  ///< [m] width and height of a picture
    Meters floor_height{3};

    static constexpr auto fields() {
        return describe(
            field("map", &SceneTable::map,
                  "ROS map.yaml, or a PNG or PGM with a size; relative to the scenario file"),
            field("size", &SceneTable::size, "width and height of a picture used as a map"),
            field("floor_height", &SceneTable::floor_height, positive, "of one storey"));
    }
};

/// [medium]
struct MediumTable {
    bool propagation_delay = true;

    static constexpr auto fields() {
        return describe(field("propagation_delay", &MediumTable::propagation_delay,
                              "frames travel at the speed of light, not at once"));
    }
};

/// [propagation]: the chosen model, and the parameters given for any listed model.
struct PropagationTable {
    std::size_t model = 1;  ///< index into PropagationModels
    PropagationModels parameters;

    /// @throws std::invalid_argument if a parameter is out of its range
    Propagation make() const;
};

/// How a frame is received.
enum class ReceptionModel { threshold };
template <>
struct EnumNames<ReceptionModel> {
    static constexpr std::array<std::string_view, 1> values = {"threshold"};
};

/// [reception]
struct ReceptionTable {
    ReceptionModel model = ReceptionModel::threshold;

    static constexpr auto fields() {
        return describe(field("model", &ReceptionTable::model,
                              "threshold: a frame is received if the link budget allows it"));
    }
};

/// Routing protocols by name.
enum class Protocol { flood };
template <>
struct EnumNames<Protocol> {
    static constexpr std::array<std::string_view, 1> values = {"flood"};
};

/// [routing]
struct RoutingTable {
    Protocol protocol = Protocol::flood;
    Flood flood;
};

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

/// What traffic is made of.
enum class TrafficKind { broadcast };
template <>
struct EnumNames<TrafficKind> {
    static constexpr std::array<std::string_view, 1> values = {"broadcast"};
};

/// [[traffic]]
struct TrafficTable {
    TrafficKind kind = TrafficKind::broadcast;
    std::string from;
    std::string payload;
    std::optional<Bytes> size;
    std::optional<Duration> start;  ///< none: when `from` arrives at the end of its movement
    std::optional<Duration> every;
    std::optional<Duration> stop;
    std::optional<int> count;
    Location from_where;
};

/// [trace]
enum class Ns2Choice { none, old_format, new_format };
template <>
struct EnumNames<Ns2Choice> {
    static constexpr std::array<std::string_view, 3> values = {"none", "old", "new"};
};
struct TraceTable {
    Ns2Choice ns2 = Ns2Choice::none;

    static constexpr auto fields() {
        return describe(field("ns2", &TraceTable::ns2, "wireless trace format of ns-2.35"));
    }
};

/// [study]: read and checked here, run by studies.
struct StudyTable {
    int replications = 1;
    Table vary;  ///< key path -> list of values

    static constexpr auto fields() {
        return describe(field("replications", &StudyTable::replications,
                              Range{.low = 1, .text = ">= 1"}, "independent repetitions"));
    }
};

/// A whole scenario with every default filled in.
struct Scenario {
    std::string file;  ///< as the user named it; maps are relative to it
    ScenarioTable scenario;
    SceneTable scene;
    Location map_where;
    Radio radio;
    MediumTable medium;
    PropagationTable propagation;
    Location propagation_where;
    ReceptionTable reception;
    std::vector<RobotTable> robots;
    RoutingTable routing;
    std::vector<TrafficTable> traffic;
    TraceTable trace;
    StudyTable study;
};

/// Reads a scenario from its document. @throws InputError at the first mistake
Scenario read_scenario(const Value& document, const std::string& file);

/// A listed model from the table of a [propagation], shadowing off.
Propagation median_propagation(const Value& table);

/// Reads a scenario file, with "path=value" options over it.
Scenario load_scenario(const std::string& path, const std::vector<std::string>& options);

/// The scenario as a document with every default; it reads back as the same scenario.
Table to_document(const Scenario& scenario);

}  // namespace rovernet
