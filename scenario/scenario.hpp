// SPDX-License-Identifier: MIT
#pragma once

#include "models/links/link_search.hpp"
#include "models/radio.hpp"
#include "scenario/access_table.hpp"
#include "scenario/metrics_table.hpp"
#include "scenario/movement_table.hpp"
#include "scenario/propagation_table.hpp"
#include "scenario/reader.hpp"
#include "scenario/reception_table.hpp"
#include "scenario/robot_table.hpp"
#include "scenario/routing_table.hpp"
#include "scenario/scene_table.hpp"
#include "scenario/study_table.hpp"
#include "scenario/trace_table.hpp"
#include "scenario/traffic_table.hpp"
#include "scenario/value.hpp"
#include "sim/fields.hpp"
#include "sim/geometry.hpp"

#include <array>
#include <cstdint>
#include <memory>
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

/// [medium]
struct MediumTable {
    bool propagation_delay = true;

    static constexpr auto fields() {
        return describe(field("propagation_delay", &MediumTable::propagation_delay,
                              "frames travel at the speed of light, not at once"));
    }
};

/// [links]: how link changes are looked for
struct LinksTable {
    Duration tolerance = LinkSearch{}.tolerance;
    Duration min_dwell = LinkSearch{}.min_dwell;

    static constexpr auto fields() {
        constexpr Range step{.low = 1e-9, .high = 1e6, .text = "from 1 ns to 1e6 s"};
        constexpr Range dwell{.low = 1e-6, .high = 1e6, .text = "from 1 us to 1e6 s"};
        return describe(field("tolerance", &LinksTable::tolerance, step,
                              "a link change behind walls is known to this"),
                        field("min_dwell", &LinksTable::min_dwell, dwell,
                              "of models of unknown shape: shorter states of a link are missed"));
    }
};

/// A whole scenario with every default filled in.
struct Scenario {
    std::string file;  ///< as the user named it; maps are relative to it
    ScenarioTable scenario;
    SceneTable scene;
    std::shared_ptr<const Scene> walls;  ///< if they are loaded already: those of a Stage world
    Radio radio;
    RadioPlaces radio_places;
    MediumTable medium;
    PropagationTable propagation;
    Location propagation_where;
    ReceptionTable reception;
    AccessTable access;
    Location access_where;
    LinksTable links;
    MovementTable movement;
    std::vector<RobotTable> robots;
    RoutingTable routing;
    std::vector<TrafficTable> traffic;
    TraceTable trace;
    MetricsTable metrics;
    StudyTable study;
    std::vector<std::string> notices;  ///< what a person should know of the files read
};

/// Reads a scenario from its document. @throws InputError at the first mistake
Scenario read_scenario(const Value& document, const std::string& file);

/// Reads [propagation] or a robot's own over `out`. @throws InputError at the first mistake
void read_propagation(const Value& value, PropagationTable& out);
/// The reverse: the chosen model's parameters, and those of others that differ from their defaults.
Table propagation_document(const PropagationTable& propagation);

struct WorldFile;

/// What the command line says over a scenario file.
struct ScenarioOptions {
    std::vector<std::string> set = {};         ///< "path=value"
    std::vector<std::string> world_path = {};  ///< folders, relative to where we are
    std::vector<std::string> bitmaps = {};     ///< "OLD=NEW"
    bool lenient = false;
};

/// A scenario file, or a Stage world (NAME.world) or movement file as a scenario of its own, with
/// what the command line says over it. Scenarios are made from it, with more settings or none.
class ScenarioFile {
  public:
    /// @param path  "-": a scenario from standard input, relative to the current folder
    /// @throws InputError
    ScenarioFile(const std::string& path, const ScenarioOptions& options);

    /// The scenario with these values (by path, as for --set) over the file's.
    /// @throws InputError at the first mistake, at the value's place if that is wrong
    Scenario scenario(const Table& settings = {}) const;

  private:
    std::string path_;
    Value document_;
    std::vector<std::string> notices_;        // of reading the world
    std::shared_ptr<const WorldFile> world_;  // if [scene] names one
};

/// ScenarioFile(path, options).scenario(), with its map loaded and its robots looked at there.
Scenario load_scenario(const std::string& path, const ScenarioOptions& options);

/// The scenario as a document with every default; it reads back as the same scenario.
Table to_document(const Scenario& scenario);

}  // namespace rovernet
