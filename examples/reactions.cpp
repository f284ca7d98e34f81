// SPDX-License-Identifier: MIT
// Robots that react: a scout drives out, and calls for help where it loses its base. A messenger
// that hears the call drives home and reports.
#include "rovernet.hpp"

#include <fmt/format.h>

using namespace rovernet;
using namespace std::chrono_literals;

int main() {
    Network net{{.propagation = Disc{.range = {50}}}};
    const auto base = net.add({.name = "base", .at = {0, 0}});
    const auto scout = net.add({.name = "scout", .at = {5, 0}});
    const auto messenger = net.add({.name = "messenger", .at = {30, 20}});
    net.route(Flood{.ttl = 1});

    const auto log = [&](NodeId robot, std::string_view what) {
        const Vec3 at = net.position(robot);
        fmt::print("{:5.1f} s  {:9} at ({:4.1f}, {:4.1f})  {}\n", seconds(net.now()),
                   net.name(robot), at.x, at.y, what);
    };
    net.move(scout, ToGoal{.to = {200, 0}, .speed = {2}});
    net.on_link_lost(scout, [&](NodeId lost) {
        if (lost != base) return;
        net.stop(scout);
        log(scout, "has lost the base, stops and calls");
        net.send(scout, everyone, "lost the base");
    });
    Subscription called = net.on_receive(messenger, [&](const Message& m) {
        log(messenger, fmt::format("hears \"{}\" from {}", m.payload, net.name(m.origin)));
        called.end();  // once is enough
        net.move(messenger, ToGoal{.to = net.position(base), .speed = {1.5}});
    });
    net.on_arrival(messenger, [&] {
        log(messenger, "is back and reports");
        net.send(messenger, base, "the scout waits at the edge");
    });
    net.on_receive(base, [&](const Message& m) {
        log(base, fmt::format("hears \"{}\" from {}", m.payload, net.name(m.origin)));
    });
    net.run_for(120s);
}
