// SPDX-License-Identifier: MIT
#include "mobility/follow.hpp"

#include "mobility/pursuit.hpp"
#include "mobility/way.hpp"

#include <algorithm>

namespace rovernet {

Step Follow::next_leg(Mover& mover) {
    check_fields(*this, name);
    const Vec3 goal = foreseen(mover, leader, mover.now, name);
    if (mover.now == start_of_run) return moment(mover);

    const Time look = mover.now + every;
    const Leg rest = straight_leg(mover, mover.position, look);
    auto way = Way::plan(mover, goal);
    if (!way) return rest;
    const double ahead = way->length_left(mover) - distance.value;
    if (!(ahead > 0)) return rest;
    const MetersPerSecond v = std::min(speed, MetersPerSecond{ahead / seconds(every)});
    const auto leg = way->next_leg(mover, v);
    return leg ? cut_short(mover, *leg, look) : rest;
}

}  // namespace rovernet
