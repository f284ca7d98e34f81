// SPDX-License-Identifier: MIT
// Robots that fail: a grid of relays loses one robot after the other, and the flood finds other
// ways until there are none.
#include "rovernet.hpp"

#include <fmt/format.h>

using namespace rovernet;
using namespace std::chrono_literals;

int main() {
    constexpr int columns = 5, rows = 3;
    Network net{{.propagation = Disc{.range = {15}}}};
    for (int i = 0; i < columns * rows; ++i)
        net.add(
            {.name = fmt::format("r{}", i), .at = {10.0 * (i % columns), 10.0 * (i / columns)}});
    net.route(Flood{.ttl = 20});
    const NodeId first{0}, last{columns * rows - 1};
    int hops = 0;
    net.on_receive(last, [&](const Heard& heard) { hops = heard.hops; });
    for (const int fails : {6, 12, 3, 7, 2}) {
        net.send(first, everyone, "are you there?");
        net.run_for(1s);
        fmt::print("{}", hops > 0 ? fmt::format("heard over {} hops", hops) : "not heard");
        hops = 0;
        net.switch_off(NodeId{static_cast<std::uint32_t>(fails)});
        fmt::print("; {} fails\n", net.name(NodeId{static_cast<std::uint32_t>(fails)}));
    }
    net.send(first, everyone, "are you there?");
    net.run_for(1s);
    fmt::print("{}\n", hops > 0 ? fmt::format("heard over {} hops", hops) : "not heard");
}
