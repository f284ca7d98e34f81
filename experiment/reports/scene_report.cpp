// SPDX-License-Identifier: MIT
#include "experiment/reports/scene_report.hpp"

#include "experiment/reports/link_graph.hpp"
#include "experiment/reports/link_table.hpp"
#include "models/medium/medium.hpp"
#include "scene/doors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <variant>

namespace rovernet {
namespace {

Table point(Vec3 p) {
    Table table;
    table.set("x_m", p.x);
    table.set("y_m", p.y);
    return table;
}

Table wall_document(const WallRectangle& wall, const Scene& scene) {
    Array corners;
    for (const Vec3 corner : wall.corners) corners.emplace_back(point(corner));
    Table table;
    table.set("corners", std::move(corners));
    table.set("material", scene.materials()[wall.material].name);
    if (scene.storeys().size() > 1) table.set("floor_m", wall.corners[0].z);
    return table;
}

Table material_document(const Material& material) {
    Table table;
    table.set("name", material.name);
    if (material.follows_model()) table.set("loss", "the propagation model's");
    if (material.per_crossing) table.set("per_crossing_db", material.per_crossing->value);
    if (material.per_metre) table.set("per_metre_db", material.per_metre->value);
    if (material.slab) {
        table.set("itu", name_of(*material.slab));
        table.set("thickness_m", material.thickness.value);
    }
    if (std::isfinite(material.height.value)) table.set("height_m", material.height.value);
    return table;
}

double free_area(const Scene& scene) {
    double area = 0;
    for (std::size_t i = 0; i < scene.storeys().size(); ++i) {
        const OccupancyGrid& grid = scene.storey(i).grid();
        const auto cells = std::count(grid.cells.begin(), grid.cells.end(), Cell::free);
        area += static_cast<double>(cells) * grid.cell_width * grid.cell_height;
    }
    return area;
}

/// Sets the heights of the floors and what the ceilings are made of, from below.
void set_storeys(Table& table, const Scene& scene) {
    if (scene.storeys().size() == 1) return;
    Array floors, ceilings;
    for (std::size_t i = 0; i < scene.storeys().size(); ++i)
        floors.emplace_back(scene.storeys().floor(i));
    for (const Material& ceiling : scene.storeys().ceilings()) {
        ceilings.emplace_back(material_document(ceiling));
    }
    table.set("floors_m", std::move(floors));
    table.set("ceilings", std::move(ceilings));
}

/// The links that work both ways, and how many work one way only.
struct Links {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> both_ways;
    std::uint64_t one_way = 0;

    explicit Links(const Network& network) {
        const auto hears = [&](std::uint32_t to, std::uint32_t from) {
            return network.medium().links().is_up(NodeId{from}, NodeId{to}, network.now(),
                                                  network.legs());
        };
        for (std::uint32_t i = 0; i < network.size(); ++i) {
            for (std::uint32_t j = 0; j < i; ++j) {
                const bool there = hears(i, j), back = hears(j, i);
                if (there && back) both_ways.emplace_back(i, j);
                if (there != back) ++one_way;
            }
        }
    }
};

Array part_names(const std::vector<std::size_t>& parts, const Network& network) {
    std::vector<Array> names;
    for (std::uint32_t i = 0; i < network.size(); ++i) {
        if (parts[i] >= names.size()) names.resize(parts[i] + 1);
        names[parts[i]].emplace_back(network.name(NodeId{i}));
    }
    Array all;
    for (Array& each : names) all.emplace_back(std::move(each));
    return all;
}

Array robot_names(const std::vector<std::size_t>& robots, const Network& network) {
    Array names;
    for (const std::size_t i : robots) {
        names.emplace_back(network.name(NodeId{static_cast<std::uint32_t>(i)}));
    }
    return names;
}

Table robot_document(const Network& network, const Device& device, NodeId node) {
    const RobotState robot = network.robot(node);
    Table table;
    table.set("name", device.robot);
    table.set("x_m", robot.at.x);
    table.set("y_m", robot.at.y);
    table.set("z_m", robot.at.z);
    table.set("heading_rad", robot.heading.value);
    table.set("on", robot.presence == Presence::on);
    table.set("presence", name_of(robot.presence));
    table.set("model", robot.propagation.name());
    table.set("power_dbm", robot.radio.power.value);
    table.set("sensitivity_dbm", robot.radio.sensitivity.value);
    table.set("frequency_hz", robot.radio.frequency.value);
    table.set("essid", device.essid);
    table.set("ip", device.ip);
    table.set("mac", device.mac);
    return table;
}

}  // namespace

Table scene_report(const Scene& scene, bool walls) {
    const Vec3 size = scene.upper_right() - scene.lower_left();
    const auto rectangles = scene.wall_rectangles();
    Table table;
    table.set("size_m", Array{size.x, size.y});
    table.set("lower_left_m", Array{scene.lower_left().x, scene.lower_left().y});
    table.set("occupied_cells", static_cast<std::uint64_t>(scene.occupied_cells()));
    table.set("wall_rectangles", static_cast<std::uint64_t>(rectangles.size()));
    table.set("free_area_m2", scene.open_field() ? Value() : Value(free_area(scene)));
    Array materials;
    for (const Material& material : scene.materials()) {
        materials.emplace_back(material_document(material));
    }
    table.set("materials", std::move(materials));
    set_storeys(table, scene);
    if (!walls) return table;
    Array list;
    for (const WallRectangle& wall : rectangles) list.emplace_back(wall_document(wall, scene));
    table.set("walls", std::move(list));
    return table;
}

void append_doors_and_stairs(Table& report, const Scenario& scenario, const Scene& scene, Time at) {
    Array doors, stairs;
    const std::vector<Door> placed = doors_of(scenario.scene);
    for (std::size_t i = 0; i < placed.size(); ++i) {
        const DoorTable& table = scenario.scene.doors[i];
        Table door;
        door.set("name", table.name.value_or(fmt::format("{}", i + 1)));
        door.set("from", point(placed[i].from));
        door.set("to", point(placed[i].to));
        if (scene.storeys().size() > 1) door.set("floor_m", placed[i].from.z);
        door.set("thickness_m", placed[i].thickness.value);
        door.set("material", table.material.value_or(scene.materials().front().name));
        const auto times = [](const std::vector<Duration>& all) {
            Array list;
            for (const Duration t : all) list.emplace_back(seconds(t));
            return list;
        };
        door.set("closes_s", times(placed[i].closes));
        door.set("opens_s", times(placed[i].opens));
        door.set("closed", placed[i].is_closed(at));
        doors.emplace_back(std::move(door));
    }
    for (const Stairs& each : stairs_of(scenario, scene.storeys())) {
        const auto place = [](Vec3 p) {
            Table table = point(p);
            table.set("z_m", p.z);
            return table;
        };
        Table table;
        table.set("foot", place(each.foot));
        table.set("head", place(each.head));
        stairs.emplace_back(std::move(table));
    }
    if (!doors.empty()) report.set("doors", std::move(doors));
    if (!stairs.empty()) report.set("stairs", std::move(stairs));
}

std::vector<Stairs> stairs_of(const Scenario& scenario, const Storeys& storeys) {
    std::vector<Stairs> all;
    const auto take = [&](Vec3 a, Vec3 b) {
        if (storeys.number_at(a.z) == storeys.number_at(b.z)) return;
        const Stairs stairs = a.z < b.z ? Stairs{a, b} : Stairs{b, a};
        const auto is_same = [&](const Stairs& each) {
            return each.foot == stairs.foot && each.head == stairs.head;
        };
        if (std::none_of(all.begin(), all.end(), is_same)) all.push_back(stairs);
    };
    for (const RobotTable& robot : scenario.robots) {
        const auto look = [&](const auto& model) {
            if constexpr (requires { model.path; }) {
                if (robot.at && !model.path.empty()) take(*robot.at, model.path.front());
                for (std::size_t i = 1; i < model.path.size(); ++i)
                    take(model.path[i - 1], model.path[i]);
            }
        };
        std::visit(look, robot.move.model);
    }
    return all;
}

void append_robots(Table& report, const Network& network) {
    const auto all = devices(network);
    Array robots;
    for (std::uint32_t i = 0; i < network.size(); ++i) {
        robots.emplace_back(robot_document(network, all[i], NodeId{i}));
    }
    report.set("robots", std::move(robots));
    if (network.size() == 0) return;
    const Links links(network);
    const LinkGraph graph = link_graph(network.size(), links.both_ways);
    Table connectivity;
    connectivity.set("links", static_cast<std::uint64_t>(links.both_ways.size()));
    connectivity.set("one_way_links", links.one_way);
    connectivity.set("components", part_names(graph.parts, network));
    connectivity.set("articulation_robots", robot_names(graph.cut, network));
    connectivity.set("diameter_hops", graph.diameter);
    report.set("connectivity", std::move(connectivity));
}

}  // namespace rovernet
