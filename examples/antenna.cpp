// SPDX-License-Identifier: MIT
// A directional antenna turns with its robot: a robot that circles in place is heard only while its
// antenna points to the base.
#include "rovernet.hpp"

#include <fmt/format.h>

#include <numbers>

using namespace rovernet;
using namespace std::chrono_literals;

int main() {
    Network net{{.propagation = Friis{}}};
    const auto base = net.add({.name = "base", .at = {0, 0}});
    const auto robot =
        net.add({.name = "robot",
                 .at = {150, 0},
                 .radio = {.antenna = AntennaShape::cosine,
                           .antenna_beamwidth = Radians{std::numbers::pi / 3},
                           .front_to_back = Db{20}},
                 .move = Driven{.turn_rate = RadiansPerSecond{std::numbers::pi / 8}}});
    net.every(1s, [&] {
        const double degrees = net.heading(robot).value * 180 / std::numbers::pi;
        const Neighbour* heard = nullptr;
        const auto links = net.links(base, net.now());  // robots that the base hears
        for (const Neighbour& each : links) heard = &each;
        fmt::print("{:2.0f} s  {:4.0f} deg  {}\n", seconds(net.now()), degrees,
                   heard ? fmt::format("{:.1f} dBm", heard->level.value) : "-");
    });
    net.run_for(16s);
}
