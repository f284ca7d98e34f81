// SPDX-License-Identifier: MIT
#pragma once

#include "models/links/link_search.hpp"
#include "models/radio.hpp"
#include "models/variation/fading.hpp"
#include "models/variation/shadowing.hpp"
#include "scenario/tables/access_table.hpp"
#include "scenario/tables/metrics_table.hpp"
#include "scenario/tables/movement_table.hpp"
#include "scenario/tables/propagation_table.hpp"
#include "scenario/tables/reader.hpp"
#include "scenario/tables/reception_table.hpp"
#include "scenario/robot_table.hpp"
#include "scenario/tables/routing_table.hpp"
#include "scenario/scene_table.hpp"
#include "scenario/tables/study_table.hpp"
#include "scenario/tables/trace_table.hpp"
#include "scenario/tables/traffic_table.hpp"
#include "scenario/document/value.hpp"
#include "sim/fields.hpp"
#include "sim/geometry.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

// A scenario file as plain structs: every table and key has one struct and field of the same name,
// with every default. experiment/build.hpp makes a Network of it.
//
//     table and key of the file                         struct and field
//     [scenario] seed     ---- read_scenario() --->     Scenario::scenario.seed
//     [radio] power       <---- to_document() -----     Scenario::radio.power

namespace rovernet {

/// [scenario]: what concerns the run as a whole.
struct ScenarioTable {
    /// Name of the run and of its output folder.
    std::string name = "run";
    /// Simulated time [ns], > 0.
    Duration duration = std::chrono::seconds{60};
    /// Seed of every random draw, and number of the independent repetition.
    std::uint64_t seed = 1;
    std::uint64_t replication = 0;
    /// Events that a run may need; one that needs more fails.
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

/// [medium]: what holds for all radios.
struct MediumTable {
    /// Frames travel at the speed of light; otherwise they arrive at once.
    bool propagation_delay = true;

    static constexpr auto fields() {
        return describe(field("propagation_delay", &MediumTable::propagation_delay,
                              "frames travel at the speed of light, not at once"));
    }
};

/// [links]: how link changes are looked for, see LinkSearch.
struct LinksTable {
    /// Error of the time of a change behind walls [ns].
    Duration tolerance = LinkSearch{}.tolerance;
    /// Duration [ns] below which a state of a link may be missed, for models of unknown shape.
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

/// Whole scenario, with every default filled in and every name and value checked.
/// network_settings() and populate() of experiment/build make a Network of it; a member has the
/// name of its table.
struct Scenario {
    /// Scenario file as the user named it; the paths in it are relative to its folder.
    std::string file;
    ScenarioTable scenario;
    SceneTable scene;
    /// Scene if it is loaded already; null: not yet, or an open field.
    std::shared_ptr<const Scene> walls;
    /// Changes of `walls` by doors if a Study has made them already; null: not yet.
    std::shared_ptr<const std::vector<SceneChange>> changes;
    /// Defaults of robots' radios, with the places of the keys that are given.
    Radio radio;
    RadioPlaces radio_places;
    MediumTable medium;
    PropagationTable propagation;
    /// Places of tables, for what is found wrong once everything is read.
    Location propagation_where;
    /// [shadowing] and [fading]; printed only if a model is chosen.
    Shadowing shadowing;
    Fading fading;
    ReceptionTable reception;
    AccessTable access;
    /// Place of [access] basic_rates if it is given, or else of the table.
    Location access_where;
    LinksTable links;
    MovementTable movement;
    /// Robots in the order of the file, those of a world first; robots that only a movement file
    /// names are in `movement`.
    std::vector<RobotTable> robots;
    RoutingTable routing;
    /// Flows, in the order of the file; each has a name.
    std::vector<TrafficTable> traffic;
    TraceTable trace;
    MetricsTable metrics;
    /// Points of `rovernet sweep`; a plain run looks at `warmup` and `metrics` only.
    StudyTable study;
    /// Notices: what a person should know of the files that were read.
    std::vector<std::string> notices;
};

/// Reads a scenario from its document, and checks it: names, addresses, memory, and values that do
/// not go together. A key that no table knows is an error. Movement and traffic files that it names
/// are read; its map is not.
/// @param document  table of tables, as read_toml() gives it
/// @param file      as the user named it, for paths in the document and for errors
/// @throws InputError at the first mistake
Scenario read_scenario(const Value& document, const std::string& file);

/// Table that reads back as the same propagation: the chosen model's parameters, and those of
/// others that differ from their defaults.
Table propagation_document(const PropagationTable& propagation);

struct WorldFile;

/// Options of the command line over a scenario file.
struct ScenarioOptions {
    /// Assignments "path=value", see set_option(): --set.
    std::vector<std::string> set = {};
    /// Folders where parts of a Stage world are looked for, relative to the current one:
    /// --world-path.
    std::vector<std::string> world_path = {};
    /// Other names of its bitmaps, "OLD=NEW": --bitmap.
    std::vector<std::string> bitmaps = {};
    /// A missing part of a world is a notice: --lenient.
    bool lenient = false;
};

/// Scenario file, or a Stage world (NAME.world) or movement file as a scenario of its own, with
/// what the command line says over it. The file is read once; a study makes a scenario of it for
/// each of its points.
class ScenarioFile {
  public:
    /// @param path  file; "-": a scenario from standard input, relative to the current folder
    /// @throws InputError for what is no scenario, with what it is and what to do
    ScenarioFile(const std::string& path, const ScenarioOptions& options);
    /// Scenario whose document was made in code.
    /// @param path  file that it stands for: paths in it are relative to its folder, or to the
    ///              current one if it is empty
    /// @throws InputError if it is no table, or for the world that it names
    ScenarioFile(Value document, const std::string& path, const ScenarioOptions& options);

    /// Scenario with these values (by path, as for --set) over the file's.
    /// @throws InputError at the first mistake, at the value's place if that is wrong
    Scenario scenario(const Table& settings = {}) const;

  private:
    // The file as it was named, and its document with the command line's values over it.
    std::string path_;
    Value document_;
    // Notices of reading the world, and the world if [scene] names one.
    std::vector<std::string> notices_;
    std::shared_ptr<const WorldFile> world_;  // if [scene] names one
};

/// Scenario of ScenarioFile(path, options), with its map loaded and its robots looked at there.
/// Commands that need one scenario call it.
/// @throws InputError as ScenarioFile, and for the map
Scenario load_scenario(const std::string& path, const ScenarioOptions& options);
/// Scenario of a file that was read before; else as above.
/// @param settings  values by path, see ScenarioFile::scenario()
Scenario load_scenario(const ScenarioFile& file, const Table& settings = {});

/// Document of a scenario with every default; it reads back as the same scenario.
Table to_document(const Scenario& scenario);

}  // namespace rovernet
