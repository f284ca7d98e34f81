// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/access.hpp"
#include "models/links/link_search.hpp"
#include "models/radio.hpp"
#include "models/variation/fading.hpp"
#include "models/variation/shadowing.hpp"
#include "scenario/document/value.hpp"
#include "scenario/robot_table.hpp"
#include "scenario/scene_table.hpp"
#include "scenario/tables/access_table.hpp"
#include "scenario/tables/metrics_table.hpp"
#include "scenario/tables/movement_table.hpp"
#include "scenario/tables/propagation_table.hpp"
#include "scenario/tables/reception_table.hpp"
#include "scenario/tables/routing_table.hpp"
#include "scenario/tables/study_table.hpp"
#include "scenario/tables/trace_table.hpp"
#include "scenario/tables/traffic_table.hpp"
#include "sim/fields.hpp"
#include "sim/geometry.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

// Structs for the tables of a scenario file. Each table has a struct, and each key has a field of
// the same name, with its default. experiment/build.hpp makes a Network of a Scenario.
//
//     table and key of the file                         struct and field
//     [scenario] seed     ---- read_scenario() --->     Scenario::scenario.seed
//     [radio] power       <---- to_document() -----     Scenario::radio.power

namespace rovernet {

/// [scenario]: settings of the whole run.
struct ScenarioTable {
    /// Name of the run and of its output folder.
    std::string name = "run";
    /// Simulated time of a run [ns], > 0.
    Duration duration = std::chrono::seconds{60};
    /// Seed of every random draw, and number of the replication (independent repetition), from 0.
    std::uint64_t seed = 1;
    std::uint64_t replication = 0;
    /// Largest number of events of a run; a run with more events fails.
    std::uint64_t event_limit = 100'000'000;

    static constexpr auto fields() {
        constexpr Range thirty_two_bits{
            .low = 0, .high = 4294967295, .text = "from 0 to 4294967295"};
        return describe(
            field("name", &ScenarioTable::name, "name of the run and of its output folder"),
            field("duration", &ScenarioTable::duration, positive, "simulated time of the run"),
            field("seed", &ScenarioTable::seed, "seed of all random draws"),
            field("replication", &ScenarioTable::replication, thirty_two_bits,
                  "number of this run among the replications (independent repetitions) of the "
                  "scenario, from 0"),
            field("event_limit", &ScenarioTable::event_limit, positive,
                  "largest number of events; a run that needs more events fails"));
    }
};

/// [medium]: settings of all radios.
struct MediumTable {
    /// True if frames travel at the speed of light; false: the propagation delay is 0.
    bool propagation_delay = true;

    static constexpr auto fields() {
        return describe(field(
            "propagation_delay", &MediumTable::propagation_delay,
            "true: frames travel at the speed of light; false: frames arrive without a delay"));
    }
};

/// [links]: accuracy of the search for times at which links come up or go down, see LinkSearch.
struct LinksTable {
    /// Largest error [ns] of the computed time at which a link through walls comes up or goes down.
    Duration tolerance = LinkSearch{}.tolerance;
    /// Sampling interval of links [ns], for propagation models whose loss is not a known function
    /// of distance. The search may miss up or down times that are shorter.
    Duration min_dwell = LinkSearch{}.min_dwell;

    static constexpr auto fields() {
        constexpr Range step{.low = 1e-9, .high = 1e6, .text = "from 1 ns to 1e6 s"};
        constexpr Range dwell{.low = 1e-6, .high = 1e6, .text = "from 1 us to 1e6 s"};
        return describe(
            field("tolerance", &LinksTable::tolerance, step,
                  "for propagation models with walls: largest error of the time at which a link "
                  "changes"),
            field("min_dwell", &LinksTable::min_dwell, dwell,
                  "for propagation models that cannot compute the time at which a link changes: "
                  "a link that is up or down for less than this time may be missed"));
    }
};

/// Complete scenario, with every default filled in and every name and value checked.
/// network_settings() and populate() of experiment/build.hpp make a Network of a Scenario. Each
/// member has the name of its table in the scenario file.
struct Scenario {
    /// Path of the scenario file, as typed. Paths in the file are relative to the file's folder.
    std::string file;
    ScenarioTable scenario;
    SceneTable scene;
    /// Scene with the walls; null: not yet loaded, or an open field.
    std::shared_ptr<const Scene> walls;
    /// Changes of the scene `walls` by its doors, computed by a Study; null: not computed.
    std::shared_ptr<const std::vector<SceneChange>> changes;
    /// [radio]: default radio of all robots, and the file positions of the keys in [radio].
    Radio radio;
    RadioPlaces radio_places;
    MediumTable medium;
    PropagationTable propagation;
    Location propagation_where;  ///< file position of [propagation], for error messages
    /// [shadowing] and [fading]: random variation of the path loss. Each table is printed only if
    /// the file chooses a model.
    Shadowing shadowing;
    Fading fading;
    ReceptionTable reception;
    AccessTable access;
    /// Settings of address resolution (ARP): keys of [access] for any access model.
    ArpSettings arp;
    /// File position of the key basic_rates of [access], or of the table [access] without this key.
    Location access_where;
    LinksTable links;
    MovementTable movement;
    /// Robots, in the order of their [[robot]] tables; robots of a Stage world come first. Robots
    /// that only a movement file names are not included; see MovementTable::robots.
    std::vector<RobotTable> robots;
    RoutingTable routing;
    /// Flows, in the order of the file; each has a name.
    std::vector<TrafficTable> traffic;
    TraceTable trace;
    MetricsTable metrics;
    /// [study]: varied keys of `rovernet sweep`; a single run uses only its `warmup` and `metrics`.
    StudyTable study;
    /// Notices to the user about the files that were read.
    std::vector<std::string> notices;
};

/// Reads a scenario from its document, and checks it: names, addresses, memory, and values that
/// contradict each other. An unknown key is an error. Movement and traffic files are read; maps are
/// not loaded.
/// @param document  table of tables, as read_toml() returns it
/// @param file      file name as the user wrote it, for paths in the document and for errors
/// @param needs_robots  true: a scenario without robots is an error
/// @param notices   notices so far, such as those of a Stage world
/// @throws InputError at the first mistake
Scenario read_scenario(const Value& document, const std::string& file, bool needs_robots = true,
                       const std::vector<std::string>& notices = {});

/// Converts a scenario to a document with every default: the inverse of read_scenario().
Table to_document(const Scenario& scenario);

}  // namespace rovernet
