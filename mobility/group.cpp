// SPDX-License-Identifier: MIT
#include "mobility/group.hpp"

#include "mobility/area.hpp"
#include "mobility/pursuit.hpp"

#include <cmath>

namespace rovernet {
namespace {

/// Path to a random position in the disc around `centre`; an empty path if none is found.
Way way_into_disc(Mover& mover, Vec3 centre, Meters radius, Draws& draws) {
    constexpr int most_tries = 16;
    for (int i = 0; i < most_tries; ++i) {
        const double r = radius.value * std::sqrt(draws.uniform(mover));
        if (auto way = Way::plan(mover, centre + r * any_direction(mover, draws))) return *way;
    }
    return {};
}

}  // namespace

Step Group::next_leg(Mover& mover) {
    check_fields(*this, name);
    if (mover.now == start_of_run) {
        foreseen(mover, leader, mover.now, name);
        return moment(mover);
    }
    auto& [draws, arrival, way] = progress;
    if (arrival <= mover.now) {
        const auto intervals = (mover.now - arrival) / every;
        arrival += (intervals + 1) * every;
        const Vec3 reference = foreseen(mover, leader, arrival, name) + Vec3{offset.x, offset.y, 0};
        way = way_into_disc(mover, reference, radius, draws);
    }
    const double metres = way.length_left(mover);
    const MetersPerSecond speed{metres / seconds(arrival - mover.now)};
    const auto leg = metres > 0 ? way.next_leg(mover, speed) : std::nullopt;
    if (!leg) return straight_leg(mover, mover.position, arrival);
    const bool last = distance(mover.position, leg->to) >= metres;
    return last && leg->end < arrival ? straight_leg(mover, leg->to, arrival)
                                      : cut_short(mover, *leg, arrival);
}

}  // namespace rovernet
