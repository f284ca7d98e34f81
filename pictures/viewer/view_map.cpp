// SPDX-License-Identifier: MIT
#include "pictures/viewer/view_map.hpp"

#include "experiment/reports/scene_report.hpp"
#include "pictures/map/link_grades.hpp"
#include "pictures/map/map_style.hpp"
#include "pictures/viewer/column.hpp"
#include "pictures/viewer/view_file.hpp"
#include "scene/doors.hpp"
#include "scene/scene.hpp"
#include "sim/fate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace rovernet {
namespace {

void add_walls(const Scene& scene, ViewFile& file) {
    std::vector<double> x, y;
    std::vector<std::uint8_t> material, storey;
    for (const WallRectangle& wall : scene.wall_rectangles()) {
        for (const Vec3 corner : wall.corners) {
            x.push_back(corner.x);
            y.push_back(corner.y);
        }
        material.push_back(static_cast<std::uint8_t>(std::min<std::size_t>(wall.material, 255)));
        storey.push_back(static_cast<std::uint8_t>(scene.storeys().number_at(wall.corners[0].z)));
    }
    file.add("walls.x", x);
    file.add("walls.y", y);
    file.add("walls.material", material);
    file.add("walls.storey", storey);
}

/// Doors as they are when the run starts. Adds their changes to the file.
Array add_doors(const Scenario& scenario, ViewFile& file) {
    struct Change {
        std::int64_t time;
        std::uint16_t door;
        bool closed;
    };
    Array list;
    std::vector<Change> changes;
    const std::vector<Door> doors = doors_of(scenario.scene);
    for (std::size_t i = 0; i < doors.size(); ++i) {
        Table door;
        door.set("name", scenario.scene.doors[i].name.value_or(fmt::format("{}", i + 1)));
        door.set("floor", doors[i].from.z);
        door.set("x0", doors[i].from.x);
        door.set("y0", doors[i].from.y);
        door.set("x1", doors[i].to.x);
        door.set("y1", doors[i].to.y);
        door.set("thickness", doors[i].thickness.value);
        door.set("closed", doors[i].is_closed(start_of_run));
        list.emplace_back(std::move(door));
        const auto number = static_cast<std::uint16_t>(i);
        for (const Duration t : doors[i].closes) changes.push_back({t.count(), number, true});
        for (const Duration t : doors[i].opens) changes.push_back({t.count(), number, false});
    }
    std::stable_sort(changes.begin(), changes.end(),
                     [](const Change& a, const Change& b) { return a.time < b.time; });
    file.add_times("doors.time",
                   column<std::int64_t>(changes, [](const Change& c) { return c.time; }));
    file.add("doors.door", column<std::uint16_t>(changes, [](const Change& c) { return c.door; }));
    file.add("doors.closed",
             column<std::uint8_t>(changes, [](const Change& c) { return c.closed; }));
    return list;
}

Array stairs_list(const Scenario& scenario, const Scene& scene) {
    Array list;
    const auto place = [](Vec3 p) { return Array{p.x, p.y, p.z}; };
    for (const Stairs& each : stairs_of(scenario, scene.storeys())) {
        Table stairs;
        stairs.set("foot", place(each.foot));
        stairs.set("head", place(each.head));
        list.emplace_back(std::move(stairs));
    }
    return list;
}

constexpr Color got{0x00, 0x9e, 0x73};  // an application got the message
/// Colours of receptions whose message no application got, by fate.
constexpr std::array outcome_colors{Color{0x56, 0xb4, 0xe9}, Color{0x56, 0xb4, 0xe9},
                                    Color{0x99, 0x99, 0x99}, Color{0x44, 0x44, 0x44},
                                    Color{0xe6, 0x9f, 0x00}, Color{0xd5, 0x5e, 0x00},
                                    Color{0xcc, 0x79, 0xa7}, Color{0x00, 0x72, 0xb2}};
static_assert(outcome_colors.size() == static_cast<std::size_t>(last_fate) + 1);
constexpr Color robot_ink{0x11, 0x11, 0x11};

Array colors_of(const ColorScale& scale) {
    Array colors;
    constexpr int last = 16;
    for (int i = 0; i <= last; ++i) colors.emplace_back(hex(scale.at(double{1} * i / last)));
    return colors;
}

}  // namespace

Table view_map(const Scenario& scenario, const NetworkSettings& settings,
               const MotionColumns::Bounds& motion, ViewFile& file) {
    static const Scene field;
    const Scene& scene = settings.scene ? *settings.scene : field;
    MotionColumns::Bounds all = motion;
    add_walls(scene, file);
    if (!scene.open_field()) {
        const Vec3 low = scene.lower_left(), high = scene.upper_right();
        all = {std::min(all.left, low.x), std::min(all.bottom, low.y), std::max(all.right, high.x),
               std::max(all.top, high.y)};
    }
    Array floors, materials;
    for (std::size_t i = 0; i < scene.storeys().size(); ++i)
        floors.emplace_back(scene.storeys().floor(i));
    for (std::size_t i = 0; i < scene.materials().size(); ++i) {
        Table material;
        material.set("name", scene.materials()[i].name);
        material.set("style", std::uint64_t{i % wall_styles.size()});
        materials.emplace_back(std::move(material));
    }
    Table map;
    map.set("bounds", Array{all.left, all.bottom, all.right, all.top});
    map.set("open_field", scene.open_field());
    map.set("floors", std::move(floors));
    map.set("materials", std::move(materials));
    map.set("doors", add_doors(scenario, file));
    map.set("stairs", stairs_list(scenario, scene));
    return map;
}

Table view_colors() {
    constexpr std::size_t categories = 7;
    Array category, walls;
    for (std::size_t i = 0; i < categories; ++i) category.emplace_back(hex(category_color(i)));
    for (const WallStyle& style : wall_styles) {
        Table wall;
        wall.set("color", hex(style.color));
        wall.set("hatch", style.hatch ? Value(style.hatch) : Value());
        walls.emplace_back(std::move(wall));
    }
    Table colors;
    colors.set("category", std::move(category));
    colors.set("lagoon", colors_of(lagoon));
    colors.set("ember", colors_of(ember));
    colors.set("balance", colors_of(balance));
    colors.set("walls", std::move(walls));
    colors.set("hatch_size", hatch_size);
    colors.set("door", hex(door_color));
    colors.set("stairs", hex(stairs_color));
    colors.set("robot", hex(robot_ink));
    Array grades;
    for (const LinkGrade& each : link_grades) {
        Table grade;
        grade.set("from_db", each.from);
        grade.set("width", each.width);
        grade.set("color", hex(ember.at(each.shade)));
        grades.emplace_back(std::move(grade));
    }
    colors.set("links", std::move(grades));
    Array outcomes;
    for (const Color color : outcome_colors) {
        for (const Color each : {color, got}) outcomes.emplace_back(hex(each));
    }
    colors.set("outcomes", std::move(outcomes));
    return colors;
}

}  // namespace rovernet
