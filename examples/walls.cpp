// SPDX-License-Identifier: MIT
// Walls: one map, drawn here as text, stands in the way of radio and of robots. A robot drives
// around the wall to a goal that it cannot see; does it hear its base on the way?
#include "rovernet.hpp"

#include <fmt/format.h>

#include <array>

using namespace rovernet;
using namespace std::chrono_literals;

/// Cells of half a metre, '#' is wall; the top row first. A map can also be read from a picture:
/// image_map("office.png", Meters{30}, Meters{20}), or read_ros_map("office.yaml").
OccupancyGrid drawn() {
    constexpr std::array rows{
        "........................",  //
        "...........##...........",  //
        "...........##...........",  //
        "...........##...........",  //
        "...........##...........",  //
        "...........##...........",  //
    };
    OccupancyGrid map;
    map.columns = 24, map.rows = 6;
    map.cell_width = map.cell_height = 0.5;
    for (auto row = rows.rbegin(); row != rows.rend(); ++row)
        for (const char* c = *row; *c; ++c)
            map.cells.push_back(*c == '#' ? Cell::occupied : Cell::free);
    return map;
}

int main() {
    const Material concrete{.name = "concrete", .per_metre = DbPerMeter{25}};  // 0.25 dB/cm
    const auto scene = std::make_shared<Scene>(drawn(), std::vector{concrete});
    Network net{{.propagation = Raytrace2007{.coefficient = 20}, .scene = scene}};
    const Radio radio{.power = 0_dBm, .sensitivity = -70_dBm};
    const auto base = net.add({.name = "base", .at = {1, 0.5}, .radio = radio});
    const auto robot = net.add({.name = "robot",
                                .at = {2, 0.5},
                                .radio = radio,
                                .move = ToGoal{.to = {11, 0.5}, .speed = {1}}});
    net.on_link_lost(robot, [&](NodeId) { fmt::print("lost at {:.1f} s\n", seconds(net.now())); });
    net.on_arrival(robot, [&] { fmt::print("there at {:.1f} s\n", seconds(net.now())); });
    net.every(2s, [&] {
        const Vec3 here = net.position(base), there = net.position(robot);
        const Db loss = net.path_loss(base, robot);
        fmt::print("{:4.1f} s at ({:4.1f}, {:.1f})  {:.1f} m of wall  {:5.1f} dB  {}\n",
                   seconds(net.now()), there.x, there.y, scene->wall_length(here, there),
                   loss.value, net.links(robot, net.now()).empty() ? "deaf" : "hears the base");
    });
    net.run_for(14s);
}
