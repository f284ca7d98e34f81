// SPDX-License-Identifier: MIT
// A door between two rooms: while it is closed, the robot behind it is not heard.
#include "rovernet.hpp"

#include <fmt/format.h>

using namespace rovernet;
using namespace std::chrono_literals;

/// A wall across a corridor of 8 m x 2 m, with a gap in its middle.
OccupancyGrid corridor() {
    OccupancyGrid map;
    map.columns = 16, map.rows = 4;
    map.cell_width = map.cell_height = 0.5;
    map.cells.assign(64, Cell::free);
    for (const int row : {0, 3}) map.cells[static_cast<std::size_t>(row) * 16 + 8] = Cell::occupied;
    return map;
}

int main() {
    const Material brick{.name = "brick", .per_crossing = 30_dB};
    const auto scene = std::make_shared<Scene>(corridor(), std::vector{brick});
    const Door door{
        .from = {4.25, 0.5}, .to = {4.25, 1.5}, .material = brick, .closes = {5s}, .opens = {12s}};
    Network net{{.propagation = MultiWall{},
                 .scene = scene,
                 .scene_changes = scene_changes(scene, std::vector{door})}};
    const Radio radio{.power = -10_dBm};
    const auto a = net.add({.name = "a", .at = {1, 1}, .radio = radio});
    const auto b = net.add({.name = "b", .at = {7, 1}, .radio = radio});
    net.route(Flood{.ttl = 1});
    net.on_receive(b,
                   [&](const Message&) { fmt::print("{:4.1f} s  heard\n", seconds(net.now())); });
    net.on_link_lost(b, [&](NodeId) { fmt::print("{:4.1f} s  lost\n", seconds(net.now())); });
    net.every(2s, [&] { net.send(a, everyone, "hello"); });
    net.run_for(17s);
}
