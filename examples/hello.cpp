// SPDX-License-Identifier: MIT
// A rover drives away from its base, which calls it every three seconds.
#include "rovernet.hpp"

#include <fmt/format.h>

using namespace rovernet;
using namespace std::chrono_literals;

int main() {
    Network net{{.seed = 7, .propagation = LogDistance{.exponent = 2.7}}};
    const Radio radio{.power = 15_dBm, .sensitivity = -90_dBm};
    const auto base = net.add({.name = "base", .at = {0, 0}, .radio = radio});
    const auto rover = net.add({.name = "rover",
                                .at = {80, 0},
                                .radio = radio,
                                .move = Waypoints{{{0s, {80, 0}}, {120s, {600, 5}}}}});
    net.route(Flood{.ttl = 3});
    double farthest = 0;
    net.on_receive(rover, [&](const Message&) { farthest = net.position(rover).x; });
    net.every(3s, [&] { net.send(base, everyone, "come back"); });
    net.run_for(120s);

    const auto metrics = net.metrics();
    fmt::print("{} of {} calls heard, up to {:.0f} m away\n", metrics.deliveries, metrics.messages,
               farthest);
}
