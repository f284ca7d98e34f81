// SPDX-License-Identifier: MIT
#include "experiment/scene_report.hpp"

#include "experiment/link_table.hpp"
#include "models/medium/medium.hpp"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/biconnected_components.hpp>
#include <boost/graph/connected_components.hpp>
#include <boost/range/iterator_range.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace rovernet {
namespace {

using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS>;

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
    const OccupancyGrid& grid = scene.grid();
    const auto cells = std::count(grid.cells.begin(), grid.cells.end(), Cell::free);
    return static_cast<double>(cells) * grid.cell_width * grid.cell_height;
}

/// The links that work both ways, and how many work one way only.
struct Links {
    Graph graph;
    std::uint64_t one_way = 0;

    explicit Links(const Network& network) : graph(network.size()) {
        const auto hears = [&](std::uint32_t to, std::uint32_t from) {
            return network.medium().link_up(NodeId{from}, NodeId{to}, network.now(),
                                            network.legs());
        };
        for (std::uint32_t i = 0; i < network.size(); ++i) {
            for (std::uint32_t j = 0; j < i; ++j) {
                const bool there = hears(i, j), back = hears(j, i);
                if (there && back) boost::add_edge(i, j, graph);
                if (there != back) ++one_way;
            }
        }
    }
};

/// The part of each robot: robots of a part are joined.
std::vector<std::size_t> parts_of(const Graph& graph) {
    std::vector<std::size_t> part(boost::num_vertices(graph));
    boost::connected_components(graph, part.data());
    return part;
}

/// How many hops the farthest robot of a part with so many robots is away. The search ends once it
/// has found them all: where most are linked, it looks at the links of a few robots only.
int eccentricity(const Graph& graph, std::size_t from, std::size_t robots) {
    std::vector<int> hops(boost::num_vertices(graph), -1);
    std::vector<std::size_t> found{from};
    found.reserve(robots);
    hops[from] = 0;
    for (std::size_t next = 0; found.size() < robots; ++next) {
        const std::size_t at = found[next];
        for (const std::size_t to :
             boost::make_iterator_range(boost::adjacent_vertices(at, graph))) {
            if (hops[to] >= 0) continue;
            hops[to] = hops[at] + 1;
            found.push_back(to);
        }
    }
    return hops[found.back()];
}

/// The longest of the shortest ways between robots that are joined, in hops.
int diameter(const Graph& graph, const std::vector<std::size_t>& parts) {
    std::vector<std::size_t> robots(parts.size());
    for (const std::size_t part : parts) ++robots[part];
    int longest = 0;
    for (std::size_t from = 0; from < parts.size(); ++from) {
        longest = std::max(longest, eccentricity(graph, from, robots[parts[from]]));
    }
    return longest;
}

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

Array cut_robots(const Graph& graph, const Network& network) {
    std::vector<std::size_t> cut;
    boost::articulation_points(graph, std::back_inserter(cut));
    std::sort(cut.begin(), cut.end());
    Array names;
    for (const std::size_t i : cut) {
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
    if (!walls) return table;
    Array list;
    for (const WallRectangle& wall : rectangles) list.emplace_back(wall_document(wall, scene));
    table.set("walls", std::move(list));
    return table;
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
    const std::vector<std::size_t> parts = parts_of(links.graph);
    Table connectivity;
    connectivity.set("links", static_cast<std::uint64_t>(boost::num_edges(links.graph)));
    connectivity.set("one_way_links", links.one_way);
    connectivity.set("components", part_names(parts, network));
    connectivity.set("articulation_robots", cut_robots(links.graph, network));
    connectivity.set("diameter_hops", diameter(links.graph, parts));
    report.set("connectivity", std::move(connectivity));
}

}  // namespace rovernet
