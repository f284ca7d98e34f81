// SPDX-License-Identifier: MIT
#include "scenario/robot_list.hpp"

#include "scenario/affected.hpp"
#include "scenario/document/located.hpp"

#include <fmt/format.h>

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace rovernet {
namespace {

/// Robots of a table that the movement file places and moves: their number, and the last name.
struct MovedByFile {
    int robots = 0;
    std::string name = {};
};
MovedByFile moved_by_file(const RobotTable& robot, const std::set<std::string_view>& in_file) {
    MovedByFile moved;
    if (in_file.empty()) return moved;
    for (int i = 0; i < robot.count.value_or(1); ++i) {
        std::string name = robot.name_of(i);
        if (in_file.contains(name)) moved = {moved.robots + 1, std::move(name)};
    }
    return moved;
}

/// Adds a notice about places and movements that have no effect beside those of the movement file.
void note_idle_motion(const Value& robots, const std::set<std::string_view>& in_file,
                      Scenario& out) {
    Affected idle;
    for (std::size_t i = 0; i < out.robots.size(); ++i) {
        const RobotTable& robot = out.robots[i];
        const MovedByFile moved = moved_by_file(robot, in_file);
        if (moved.robots == 0) continue;
        const bool stands = std::holds_alternative<FixedTable>(robot.move.model);
        for (const char* key : {"at", "place", "move"}) {
            const Value* given = (*robots.array())[i].table()->find(key);
            if (!given || (stands && key == std::string_view("move"))) continue;
            // A world has to place all its robots.
            if (out.scene.world && given->where.source != out.file) continue;
            idle.add([&] {
                return fmt::format(
                    "{}: the key \"{}\" has no effect on robot \"{}\": the movement file places "
                    "and moves this robot",
                    given->where.text(), key, moved.name);
            });
        }
    }
    idle.note(out.notices);
}

}  // namespace

void read_robots(TableReader& document, Scenario& out) {
    std::set<std::string_view> in_file;
    for (const FileRobot& robot : out.movement.robots) in_file.insert(robot.name);
    const auto needs_place = [&](const RobotTable& robot) {
        return moved_by_file(robot, in_file).robots < robot.count.value_or(1);
    };
    std::vector<std::string> placed(in_file.begin(), in_file.end());
    std::vector<RobotTable> robots;
    for (const Value& table : document.take_list("robot")) {
        robots.push_back(read_robot(table, out, needs_place, placed));
        const bool is_of_world = out.scene.world && table.where.source != out.file;
        if (is_of_world) placed.push_back(robots.back().name);
    }
    out.robots = std::move(robots);
    if (!in_file.empty() && !out.robots.empty()) {
        note_idle_motion(*document.take("robot"), in_file, out);
    }
}

void check_robots(TableReader& document, const Scenario& scenario, bool needs_robots) {
    if (!scenario.robots.empty() || !scenario.movement.robots.empty()) return;
    const bool has_map = scenario.scene.has_maps() || scenario.scene.world;
    if (!needs_robots && has_map) return;
    if (const auto& file = scenario.movement.file) {
        located_file(scenario.movement.where, "file", [&]() -> void {
            throw InputError({*file},
                             "found no robot in this movement file; expected at least "
                             "one robot with a position");
        });
    }
    if (!scenario.scene.world) {
        document.missing("robot", needs_robots ? "[[robot]] with a name and a place"
                                               : "[[robot]] with a name and a place, or [scene] "
                                                 "with a map");
    }
    std::string message =
        "found no robot in this world; expected a model of type position, or a scenario with "
        "[[robot]] that names the world: [scene] world = \"...\"";
    for (const std::string& notice : scenario.notices) message += "\n  " + notice;  // the reasons
    throw InputError(
        scenario.scene.map_where.line > 0 ? scenario.scene.map_where : Location{scenario.file},
        message);
}

}  // namespace rovernet
