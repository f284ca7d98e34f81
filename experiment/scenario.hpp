// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/propagation_table.hpp"
#include "experiment/reader.hpp"
#include "experiment/robot_table.hpp"
#include "experiment/value.hpp"
#include "models/radio.hpp"
#include "routing/flood.hpp"
#include "sim/fields.hpp"
#include "sim/geometry.hpp"

#include <cstdint>
#include <optional>
#include <string>
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

/// Reads a scenario file, with "path=value" options over it.
Scenario load_scenario(const std::string& path, const std::vector<std::string>& options);

/// The scenario as a document with every default; it reads back as the same scenario.
Table to_document(const Scenario& scenario);

}  // namespace rovernet
