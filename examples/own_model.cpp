// SPDX-License-Identifier: MIT
// A propagation model of one's own: a greenhouse, where leaves take a share of the signal with
// every metre. How far may a rover drive from its base before it is lost?
#include "rovernet.hpp"

#include <fmt/format.h>

using namespace rovernet;
using namespace std::chrono_literals;

/// Free space, and what the plants between the antennas take:  L(d) = friis(d) + a d.
struct Greenhouse {
    static constexpr std::string_view name = "greenhouse";

    DbPerMeter foliage{0.4};  ///< a [dB/m], >= 0

    static constexpr auto fields() {
        return describe(field("foliage", &Greenhouse::foliage, non_negative, "taken by leaves"));
    }

    /// The loss goes by the distance alone, so that links and their changes are found exactly.
    LossShape shape() const { return LossShape::by_distance; }

    void loss(const LinkBatch& links, Db cutoff, std::span<double> out_db) const {
        Friis{}.loss(links, cutoff, out_db);
        for (std::size_t i = 0; i < out_db.size(); ++i)
            out_db[i] += foliage.value * links.distance(i);
    }
};

/// Drives a rover away from its base. @return how far it was when it heard the base last [m]
double range_of(Propagation model) {
    Network net{{.propagation = std::move(model)}};
    const Radio radio{.power = 15_dBm, .sensitivity = -85_dBm};
    const NodeId base = net.add({.name = "base", .at = {0, 0}, .radio = radio});
    const NodeId rover = net.add({.name = "rover",
                                  .at = {1, 0},
                                  .radio = radio,
                                  .move = ToGoal{.to = {2000, 0}, .speed = {2}}});
    double last = 0;
    net.on_link_lost(rover,
                     [&](NodeId) { last = distance(net.position(base), net.position(rover)); });
    net.run_for(1000s);
    return last;
}

int main() {
    fmt::print("no leaves   {:6.1f} m\n", range_of(Friis{}));
    for (const double a : {0.1, 0.4, 1.0})
        fmt::print("{:.1f} dB/m    {:6.1f} m\n", a, range_of(Greenhouse{.foliage = {a}}));
    try {
        range_of(Greenhouse{.foliage = {-1}});
    } catch (const std::invalid_argument& error) {
        fmt::print("{}\n", error.what());
    }
}
