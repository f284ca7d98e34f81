// SPDX-License-Identifier: MIT
// A study in code: twenty robots wander about; a message is flooded over one, two, three hops. How
// many get it? Each case is run thirty times, with the same robots on the same ways, and every mean
// has its interval.
#include "rovernet.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

using namespace rovernet;
using namespace std::chrono_literals;

/// The share of the other robots that get a message, in one replication.
double delivery_ratio(int ttl, std::uint32_t replication) {
    Network net{{.seed = 7,
                 .replication = replication,
                 .propagation = LogDistance{.exponent = 3, .sigma = 4_dB},
                 .reception = Collision{}}};
    const RandomWaypoint wander{.area = {Vec3{0, 0}, Vec3{150, 150}}};
    for (int i = 0; i < 20; ++i)
        net.add({.name = fmt::format("rover{}", i), .at = {}, .move = wander});
    net.route(Flood{.ttl = ttl});
    net.every(10s, [&] { net.send(NodeId{0}, everyone, "who is there?"); });
    net.run_for(100s);
    net.finish();
    return *net.metrics().delivery_ratio;
}

int main() {
    fmt::print("ttl   mean   95 % interval\n");
    const Bounds shares = bounds_of("delivery_ratio");  // 0 to 1
    std::vector<double> before;
    for (const int ttl : {1, 2, 3}) {
        std::vector<double> ratios, gains;
        for (std::uint32_t r = 0; r < 30; ++r) {
            ratios.push_back(delivery_ratio(ttl, r));
            if (!before.empty()) gains.push_back(ratios.back() - before[r]);
        }
        const auto interval = interval_of(ratios, shares);
        fmt::print("{:3}  {:.3f}   {:.3f} to {:.3f}", ttl, summary_of(ratios)->mean, interval->low,
                   interval->high);
        if (!gains.empty()) {  // paired: the same replication of both
            const auto gain = interval_of(gains, difference_bounds(shares));
            fmt::print("   more by {:.3f} to {:.3f}", gain->low, gain->high);
        }
        fmt::print("\n");
        before = ratios;
    }
}
