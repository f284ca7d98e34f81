// SPDX-License-Identifier: MIT
// Hidden nodes: two robots that do not hear each other send to one between them. Frames that
// collide are lost without an access model. csma repeats them; behind an RTS hardly any has to be
// repeated.
#include "rovernet.hpp"

#include <fmt/format.h>

using namespace rovernet;
using namespace std::chrono_literals;

void run(std::string_view what, AccessModel access) {
    Network net{{.propagation = Disc{.range = {60}},
                 .reception = Collision{},
                 .access = std::move(access)}};
    const auto left = net.add({.name = "left", .at = {0, 0}});
    const auto middle = net.add({.name = "middle", .at = {50, 0}});
    const auto right = net.add({.name = "right", .at = {100, 0}});
    net.route(Flood{.ttl = 1});
    net.every(10ms, [&] { net.send(left, middle, "a", {.size = 1000}); });
    net.every(10100us, [&] { net.send(right, middle, "b", {.size = 1000}); });
    net.run_for(10s);
    const auto metrics = net.metrics();
    fmt::print("{:14} {:4} of {} delivered in {} frames\n", what, metrics.deliveries,
               metrics.messages, metrics.transmissions);
}

int main() {
    run("none", NoAccess{});
    run("csma", Csma{});
    run("csma with RTS", Csma{.rts_threshold = 0});
}
