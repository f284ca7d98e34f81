// SPDX-License-Identifier: MIT
#include "experiment/recorded_scenario.hpp"

#include "experiment/run_folder.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario_file.hpp"
#include "scene/wall_digest.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

namespace rovernet {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_attached = 64 << 20;  // [bytes]

/// The name of the picture in a map of ROS, if it lies beside the map.
std::optional<std::string> picture_of(const fs::path& map) {
    std::ifstream file(map);
    constexpr std::string_view key = "image:";
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with(key)) continue;
        std::string name = line.substr(key.size());
        name.erase(std::min(name.find('#'), name.size()));
        const auto is_frame = [](char c) { return c == ' ' || c == '"' || c == '\'' || c == '\r'; };
        while (!name.empty() && is_frame(name.back())) name.pop_back();
        name.erase(name.begin(), std::find_if_not(name.begin(), name.end(), is_frame));
        if (name.empty() || fs::path(name).has_parent_path()) return std::nullopt;
        return name;
    }
    return std::nullopt;
}

/// Attaches files of one folder; none of them if one is missing or they are very large.
bool attach(const std::vector<fs::path>& paths, const std::string& folder,
            std::vector<AttachedFile>& files) {
    std::uintmax_t size = 0;
    std::error_code error;
    for (const fs::path& path : paths) {
        const auto bytes = fs::file_size(path, error);
        if (error || (size += bytes) > largest_attached) return false;
    }
    for (const fs::path& path : paths) {
        std::ifstream in(path, std::ios::binary);
        std::ostringstream content;
        content << in.rdbuf();
        files.push_back({fmt::format("{}/{}", folder, path.filename().string()),
                         "application/octet-stream", content.str()});
    }
    return true;
}

/// The key of a table in the document, if it is a text.
const std::string* text_at(Table& document, std::string_view table, std::string_view key) {
    Value* section = document.find(table);
    const Value* value = section && section->table() ? section->table()->find(key) : nullptr;
    return value ? value->string() : nullptr;
}

void put_file(const fs::path& path, const std::string& content) {
    fs::create_directories(path.parent_path());
    std::ofstream out(path, std::ios::binary);
    out << content;
    if (!out.flush())
        throw RunError(path.string() +
                       ": this file cannot be written; check the space on the disk");
}

/// Digest of the walls of a world; a word if the world has none.
std::string digest_of_walls(const Scenario& scenario) {
    return scenario.walls ? wall_digest(*scenario.walls) : "none";
}

/// Whether a file of this name stays inside its folder.
bool is_inside(const std::string& name) {
    const fs::path path(name);
    return name.find('\0') == name.npos && path.has_filename() && path.is_relative() &&
           std::none_of(path.begin(), path.end(),
                        [](const fs::path& part) { return part == ".."; });
}

}  // namespace

RecordedScenario recorded_scenario(const Scenario& scenario, const std::string& folder) {
    RecordedScenario recorded;
    Table document = document_in(folder, scenario);
    const fs::path here = fs::path(scenario.file).parent_path();
    const auto take = [&](Table& table, const char* key, const std::string& into,
                          std::vector<fs::path> paths) {
        if (!attach(paths, into, recorded.files)) return;
        table.set(key, fmt::format("{}/{}", into, paths.front().filename().string()));
    };
    const auto take_map = [&](Table& table, const std::string& into, const std::string& map) {
        std::vector<fs::path> paths{here / map};
        const std::string ending = paths[0].extension().string();
        const bool names_picture = ending == ".yaml" || ending == ".yml";
        const auto picture = names_picture ? picture_of(paths[0]) : std::nullopt;
        if (picture) paths.push_back(paths[0].parent_path() / *picture);
        if (picture || !names_picture) take(table, "map", into, std::move(paths));
    };
    Table& scene = *document.find("scene")->table();
    if (scenario.scene.map) take_map(scene, "map", *scenario.scene.map);
    for (std::size_t i = 0; i < scenario.scene.floors.size(); ++i) {
        Table& floor = *(*scene.find("floor")->array())[i].table();
        take_map(floor, fmt::format("floor{}", i), scenario.scene.floors[i].map);
    }
    if (const auto& file = scenario.movement.file)
        take(*document.find("movement")->table(), "file", "file", {here / *file});
    recorded.text = to_toml(document);
    if (scenario.scene.world) recorded.walls = digest_of_walls(scenario);
    return recorded;
}

std::string ReplayedScenario::find_file(const RecordedRun& run, const std::string& name) const {
    const auto has_its_name = [&](const AttachedFile& file) { return file.name == name; };
    if (std::any_of(run.files.begin(), run.files.end(), has_its_name)) return name;
    if (std::find(run.broken.begin(), run.broken.end(), name) != run.broken.end()) {
        throw InputError(
            {.source = trace_},
            fmt::format("the file {}, which this trace contains, is damaged; record the run again",
                        name));
    }
    // At its place when the run was recorded, or copied into the folder of the trace.
    const fs::path home = fs::absolute(trace_).parent_path();
    for (const fs::path& file : {home / name, home / fs::path(name).filename()}) {
        std::error_code ignored;
        if (fs::exists(file, ignored)) return file.string();
    }
    throw InputError(
        {.source = trace_},
        fmt::format(
            "the scenario of this trace needs the file {}, but neither the trace nor the folder of "
            "the trace contains this file; copy the file into the folder of the trace",
            name));
}

ReplayedScenario::ReplayedScenario(const RecordedRun& run, const std::string& path)
    : trace_(path), walls_(run.walls) {
    if (run.scenario.empty()) {
        throw InputError({.source = path},
                         "this trace has no scenario, because a C++ program built its network; "
                         "expected a trace of rovernet run --record");
    }
    Value parsed = parse_toml(run.scenario, path);
    Table& document = *parsed.table();
    for (const AttachedFile& file : run.files) {
        if (!is_inside(file.name)) continue;
        try {
            put_file(fs::path(folder_.path()) / file.name, file.content);
        } catch (const fs::filesystem_error&) {  // a file is inside where another has its folder
            throw InputError(
                {.source = path},
                fmt::format(
                    "the file {}, which this trace contains, cannot be stored "
                    "in a temporary folder; check the space on the disk, or record the run again",
                    file.name));
        }
    }
    constexpr std::pair<const char*, const char*> keys[] = {
        {"scene", "map"}, {"scene", "world"}, {"movement", "file"}};
    for (const auto& [table, key] : keys) {
        const std::string* name = text_at(document, table, key);
        if (name) document.find(table)->table()->set(key, find_file(run, *name));
    }
    Value* scene = document.find("scene");
    Value* floors = scene && scene->table() ? scene->table()->find("floor") : nullptr;
    if (floors && floors->array()) {
        for (Value& each : *floors->array()) {
            const Value* map = each.table() ? each.table()->find("map") : nullptr;
            if (map && map->string()) each.table()->set("map", find_file(run, *map->string()));
        }
    }
    Value* places = scene && scene->table() ? scene->table()->find("world_path") : nullptr;
    if (places && places->array()) {
        const fs::path home = fs::absolute(path).parent_path();
        for (Value& each : *places->array()) {
            if (each.string()) each = (home / *each.string()).string();
        }
    }
    file_ = folder_.path() + "/scenario.toml";
    put_file(file_, to_toml(document));
}

Scenario ReplayedScenario::with(const std::vector<std::string>& set) const {
    try {
        Scenario scenario = load_scenario(file_, {.set = set});
        const bool changes_scene = std::ranges::any_of(
            set, [](const std::string& option) { return first_key(option) == "scene"; });
        if (!changes_scene) check_walls(scenario);
        return scenario;
    } catch (const InputError& error) {
        // The user gave the assignments by --with, and does not know the temporary folder.
        constexpr std::string_view option = "--set ";
        Location where = error.where();
        const std::string here = folder_.path() + "/";
        std::string message = error.message();
        const auto at = message.find(here);
        if (at != message.npos) message.erase(at, here.size());
        if (where.source.starts_with(option)) {
            where.source.replace(0, option.size(), "--with ");
        } else if (at != message.npos) {
            throw InputError({.source = trace_},
                             fmt::format("a file of the scenario of this trace cannot be read: {}; "
                                         "if the trace is cut off, record the run again",
                                         message));
        } else if (where.source.starts_with(here)) {
            where.source.replace(0, here.size(), trace_ + ": ");
        } else {
            throw;
        }
        throw InputError(where, message);
    }
}

/// A world and its parts are not attached to the trace, so they may have changed.
void ReplayedScenario::check_walls(const Scenario& scenario) const {
    if (walls_.empty() || digest_of_walls(scenario) == walls_) return;
    throw InputError({.source = trace_},
                     fmt::format("the walls of {} have changed since this run was recorded, so its "
                                 "levels cannot be computed; restore the world with its includes "
                                 "and bitmaps, or record the run again",
                                 fs::path(*scenario.scene.world).lexically_normal().string()));
}

void check_robots(const RecordedRun& run, const Scenario& scenario, const std::string& path) {
    const std::vector<std::string>& names = run.robots;
    std::size_t robots = 0;
    const auto expect = [&](const std::string& name) {
        if (robots == names.size()) {
            throw InputError(
                {.source = path},
                fmt::format("the scenario of this trace has a robot \"{}\" with number {} (counted "
                            "from 0), but {}",
                            name, robots, run.names_in_words()));
        }
        if (names[robots] != name) {
            throw InputError({.source = path},
                             fmt::format("robot {} is named \"{}\" in the trace, but \"{}\" in the "
                                         "scenario of the trace",
                                         robots, names[robots], name));
        }
        ++robots;
    };
    std::set<std::string> in_tables;
    for (const RobotTable& table : scenario.robots) {
        for (int i = 0; i < table.count.value_or(1); ++i) {
            expect(table.name_of(i));
            in_tables.insert(table.name_of(i));
        }
    }
    for (const FileRobot& robot : scenario.movement.robots) {
        if (!in_tables.contains(robot.name)) expect(robot.name);
    }
    if (robots == names.size()) return;
    throw InputError({.source = path},
                     fmt::format("the scenario of this trace has {} robots, but {}", robots,
                                 run.names_in_words()));
}

}  // namespace rovernet
