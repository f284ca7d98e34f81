// SPDX-License-Identifier: MIT
// A movement of one's own: a robot that mows a field in lanes, and how long its base hears it.
#include "rovernet.hpp"

#include <fmt/format.h>

using namespace rovernet;
using namespace std::chrono_literals;

/// Drives up one lane and down the next. A model answers a robot's next leg whenever one has ended.
struct Mow {
    double length;             ///< of a lane [m], along y
    double gap;                ///< between two lanes [m], along x
    int lanes;                 ///< number of lanes
    MetersPerSecond speed{1};  ///< [m/s], > 0
    int done = 0;              ///< legs that have begun

    Step next_leg(Mover& mover) {
        if (done == 2 * lanes - 1) return AtRest{};
        const bool along = done % 2 == 0;
        const double y = done % 4 < 2 ? length : 0;
        const double x = gap * ((done + 1) / 2);
        ++done;
        return straight_leg(mover, along ? Vec3{mover.position.x, y} : Vec3{x, y}, speed);
    }
};

int main() {
    Network net{{.propagation = Disc{.range = {40}}}};
    const auto base = net.add({.name = "base", .at = {0, 0}});
    const auto mower =
        net.add({.name = "mower", .at = {0, 0}, .move = Mow{.length = 30, .gap = 10, .lanes = 4}});
    int in_touch = 0;
    net.every(1s, [&] { in_touch += net.links(base, net.now()).empty() ? 0 : 1; });
    net.on_link_lost(base, [&](NodeId) {
        const Vec3 at = net.position(mower);
        fmt::print("{:5.1f} s  lost at ({:.1f}, {:.1f}) m\n", seconds(net.now()), at.x, at.y);
    });
    net.on_arrival(mower, [&] { fmt::print("{:5.1f} s  done\n", seconds(net.now())); });
    net.run_for(200s);
    fmt::print("in touch for {} of 200 s\n", in_touch);
}
