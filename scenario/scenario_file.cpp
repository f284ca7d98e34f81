// SPDX-License-Identifier: MIT
#include "scenario/scenario_file.hpp"

#include "files/input_file.hpp"
#include "scenario/document/located.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/other_files.hpp"
#include "scenario/scenario.hpp"
#include "scenario/stage/stage_world.hpp"
#include "scenario/tables/read_value.hpp"
#include "scenario/unlikely.hpp"
#include "scenario/unlikely_walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

namespace rovernet {
namespace {

namespace fs = std::filesystem;

bool is_world(const std::string& path) { return fs::path(path).extension() == ".world"; }

/// A Stage world alone, as the document of a scenario.
Value world_alone(const std::string& path) {
    Table scene, scenario, document;
    scene.set("world", fs::path(path).filename().string());
    scenario.set("name", fs::path(path).stem().string());
    document.set("scenario", std::move(scenario));
    document.set("scene", std::move(scene));
    return document;
}

/// Whether a line that begins with a letter is one of Tcl: `set NAME VALUE`, not `set = VALUE`.
bool is_tcl(std::istream& line) {
    std::string first, second;
    line >> first >> second;
    return first == "set" && !second.starts_with('=');
}

/// Whether the file is compressed, or in an unsupported encoding; then the content decides, or the
/// reader of movement files reports the error.
bool is_packed(std::istream& file) {
    constexpr std::string_view marks[] = {{"\x1f", 1}, "\x28\xb5\x2f\xfd", "\xfd\x37zXZ",
                                          "BZh",       "7z\xbc\xaf",       "PK\x03\x04",
                                          "\xff\xfe",  "\xfe\xff"};
    std::string begin(6, '\0');
    file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
    file.clear();
    file.seekg(0);
    return std::any_of(std::begin(marks), std::end(marks),
                       [&](std::string_view mark) { return begin.starts_with(mark); });
}

/// Skips blanks and comments. @return the first other character; 0 at the end
char first_sign(std::istream& file) {
    for (char c = 0; file.get(c);) {
        if (c == '#') {
            std::string comment;
            std::getline(file, comment);
        } else if (c != ' ' && c != '\t' && c != '\r' && c != '\n') {
            file.unget();
            return c;
        }
    }
    return 0;
}

/// Whether the file begins with a Tcl variable, like a script that contains movements.
bool begins_as_tcl(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return first_sign(file) == 's' && is_tcl(file);
}

/// Whether a file is a movement file: by its name (.tcl), or by its first character outside
/// comments: `$`, `<`, a digit, `set` or the magic number of a compressed file. A TOML file begins
/// with a letter, a quote or a bracket.
bool is_movement(const std::string& path) {
    if (fs::path(path).extension() == ".toml" || input_kind(path) != InputKind::file) return false;
    std::ifstream file(path, std::ios::binary);
    if (is_packed(file) || fs::path(path).extension() == ".tcl") return true;
    const char c = first_sign(file);
    return c == '$' || c == '<' || c == '-' || (c >= '0' && c <= '9') || begins_as_tcl(path);
}

/// A movement file alone, as the document of a scenario that lasts as long.
Value movement_alone(const std::string& path) {
    Table movement, scenario, document;
    const MovementFile file(path, MovementSyntax::tolerant);
    if (begins_as_tcl(path) && file.robots().empty()) {
        throw InputError({path},
                         "no line of this file places or moves a robot; expected a movement file "
                         "with lines such as $node_(0) set X_ 10.0; \"rovernet help "
                         "coming-from-ns\" shows what replaces a script of ns-2");
    }
    const Time end = file.end();
    if (end > last_of_run) {
        throw InputError(
            file.end_where(),
            fmt::format("the movements end after {:.10g} s, expected at most 1e9 s (31 years); to "
                        "play only the first part of the movements, write a scenario with the keys "
                        "[movement] file and [scenario] duration",
                        seconds(end - start_of_run)));
    }
    movement.set("file", fs::path(path).filename().string());
    if (begins_as_tcl(path)) movement.set("syntax", "tolerant");
    scenario.set("name", fs::path(path).stem().string());
    scenario.set("duration", to_value(std::max(end - start_of_run, Duration{1'000'000'000})));
    document.set("scenario", std::move(scenario));
    document.set("movement", std::move(movement));
    return document;
}

/// Appends strings to a list of [scene].
void append(Value& scene, std::string_view key, const std::vector<std::string>& more) {
    if (more.empty()) return;
    const Value* old = scene.table()->find(key);
    Array list = old && old->array() ? *old->array() : Array{};
    for (const std::string& each : more) list.emplace_back(each);
    scene.table()->set(key, std::move(list));
}

/// Moves the world options of the command line to keys of [scene], if it names a world.
void apply_world_options(Table& document, ScenarioOptions& options, const fs::path& folder) {
    Value* scene = document.find("scene");
    if (!scene || !scene->table() || !scene->table()->find("world")) return;
    std::vector<std::string> path;
    for (const std::string& each : options.world_path) {
        path.push_back(fs::proximate(each, folder.empty() ? "." : folder).string());
    }
    append(*scene, "world_path", path);
    append(*scene, "bitmaps", options.bitmaps);
    options.world_path.clear(), options.bitmaps.clear();
    if (options.lenient) scene->table()->set("lenient", true);
}

/// Merges a table into another one: its values win, recursively in nested tables.
void lay_over(Table& lower, const Table& upper) {
    for (const Entry& entry : upper.entries) {
        Value* old = lower.find(entry.key);
        if (old && old->table() && entry.value.table()) {
            lay_over(*old->table(), *entry.value.table());
        } else {
            lower.set(entry.key, entry.value);
        }
    }
}

const std::string* name_in(const Value& robot) {
    const Value* name = robot.table() ? robot.table()->find("name") : nullptr;
    return name ? name->string() : nullptr;
}

/// Robots of the world, each overridden by the document's robot of the same name, then the other
/// robots of the document.
Array merged_robots(const Array& of_world, const Array& of_document) {
    Array all = of_world;
    std::set<std::string> merged;
    for (const Value& robot : of_document) {
        const std::string* name = name_in(robot);
        if (name && !merged.insert(*name).second) {
            throw InputError(robot.where,
                             fmt::format("a second [[robot]] is named \"{}\"; expected "
                                         "one table for each robot",
                                         *name));
        }
        const auto same = std::find_if(all.begin(), all.end(), [&](const Value& other) {
            return name && name_in(other) && *name_in(other) == *name;
        });
        if (same == all.end()) {
            all.push_back(robot);
        } else {
            if (robot.table()->find("place")) {
                std::erase_if(same->table()->entries, [](const Entry& e) { return e.key == "at"; });
            }
            lay_over(*same->table(), *robot.table());
        }
    }
    return all;
}

/// Merges the values of the world into the document; values of the document win.
void add_world(Table& document, const Table& world) {
    Table all = world;
    const Value* below = world.find("robot");
    const Value* above = document.find("robot");
    Array robots;
    if (!above || above->array()) {
        robots = merged_robots(below && below->array() ? *below->array() : Array{},
                               above ? *above->array() : Array{});
    }
    lay_over(all, document);
    if (!robots.empty()) all.set("robot", std::move(robots));
    document = std::move(all);
}

/// Whether a setting chooses a Stage world, or how the world is read.
bool chooses_world(const Entry& setting) {
    constexpr std::string_view keys[] = {"scene", "scene.world", "scene.world_path",
                                         "scene.bitmaps", "scene.lenient"};
    return std::ranges::find(keys, setting.key) != std::end(keys);
}

/// The document that a file is, or is made into.
Value document_of(const std::string& path) {
    refuse_other_files(path);
    if (is_world(path)) return world_alone(path);
    return is_movement(path) ? movement_alone(path) : read_toml(path);
}

}  // namespace

ScenarioFile::ScenarioFile(const std::string& path, const ScenarioOptions& options)
    : ScenarioFile(document_of(path), path, options) {}

ScenarioFile::ScenarioFile(Value document, const std::string& path, const ScenarioOptions& options)
    : path_(path), options_(options), without_world_(std::move(document)) {
    if (!without_world_.table()) {
        throw InputError(without_world_.where,
                         fmt::format("found {}; expected a table that contains the tables of a "
                                     "scenario, such as [[robot]]",
                                     without_world_.description()));
    }
    const fs::path folder = fs::path(path).parent_path();
    // Options about the scene decide which world is read. The others may name its robots.
    std::erase_if(options_.set, [&](const std::string& option) {
        if (first_key(option) != "scene") return false;
        set_option(without_world_, option, "--set " + option);
        return true;
    });
    apply_world_options(*without_world_.table(), options_, folder);
    document_ = without_world_;
    const Value* scene = document_.table()->find("scene");
    if (scene && scene->table() && scene->table()->find("world")) {
        const SceneTable said = read_scene(*scene);
        WorldFile world = located_file(said.map_where, "world", [&] {
            return read_worldfile((folder / *said.world).string(), world_options(said, path));
        });
        notices_ = world.notices;
        add_world(*document_.table(), stage_document(world, notices_));
        world_ = std::make_shared<const WorldFile>(std::move(world));
    }
    for (const auto& option : options_.set) set_option(document_, option, "--set " + option);
}

Scenario ScenarioFile::scenario(const Table& settings) const {
    Value document = document_;
    if (std::ranges::any_of(settings.entries, chooses_world)) {
        Value chosen = without_world_;
        Table others;
        for (const Entry& entry : settings.entries) {
            if (chooses_world(entry)) {
                set_value(chosen, entry.key, entry.value, entry.key_where);
            } else {
                others.entries.push_back(entry);
            }
        }
        return ScenarioFile(std::move(chosen), path_, options_).scenario(others);
    }
    for (const Entry& entry : settings.entries) {
        set_value(document, entry.key, entry.value, entry.key_where);
    }
    Scenario scenario = read_scenario(document, path_, options_.needs_robots, notices_);
    std::vector<std::string> of_walls;
    if (world_) scenario.walls = load_walls(scenario.scene, path_, *world_, of_walls);
    const auto first = scenario.notices.begin() + static_cast<std::ptrdiff_t>(notices_.size());
    scenario.notices.insert(first, of_walls.begin(), of_walls.end());
    return scenario;
}

Scenario load_scenario(const std::string& path, const ScenarioOptions& options) {
    return load_scenario(ScenarioFile(path, options));
}

Scenario load_scenario(const ScenarioFile& file, const Table& settings) {
    Scenario scenario = file.scenario(settings);
    if (!scenario.walls) {
        scenario.walls = load_map(scenario.scene, scenario.file, scenario.notices);
    }
    note_places(scenario, scenario.walls.get());
    note_antennas(scenario, scenario.walls.get());
    note_walls_twice(scenario, scenario.walls.get());
    note_coherent_slants(scenario, scenario.walls.get());
    note_thick_walls(scenario, scenario.walls.get());
    return scenario;
}

}  // namespace rovernet
