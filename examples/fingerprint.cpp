// SPDX-License-Identifier: MIT
// Determinism: a scenario, a seed and a replication always give the same run, to the last bit. The
// fingerprint of a run shows it.
#include "rovernet.hpp"

#include <fmt/format.h>

using namespace rovernet;
using namespace std::chrono_literals;

std::string run(std::uint64_t seed, std::uint32_t replication) {
    Network net{{.seed = seed,
                 .replication = replication,
                 .propagation = LogDistance{.exponent = 3, .sigma = 4_dB}}};
    for (int i = 0; i < 5; ++i)
        net.add({.name = fmt::format("rover{}", i),
                 .at = {},
                 .move = RandomWaypoint{.area = {Vec3{0, 0}, Vec3{100, 100}}}});
    net.route(Flood{});
    const auto fingerprint = std::make_shared<Fingerprint>();
    net.add_sink(fingerprint);
    net.every(1s, [&] { net.send(NodeId{0}, everyone, "ping"); });
    net.run_for(20s);
    return fingerprint->text();
}

int main() {
    const std::string first = run(7, 0);
    fmt::print("seed 7, replication 0: {}\n", first);
    fmt::print("once more:             {}\n", run(7, 0) == first ? "the same" : "another");
    fmt::print("replication 1:         {}\n", run(7, 1) == first ? "the same" : "another");
    fmt::print("seed 8:                {}\n", run(8, 0) == first ? "the same" : "another");
}
