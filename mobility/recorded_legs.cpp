// SPDX-License-Identifier: MIT
#include "mobility/recorded_legs.hpp"

#include "sim/legs.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace rovernet {

RecordedLegs::RecordedLegs(std::vector<Leg> legs) {
    const auto is_late = [](const Leg& a, const Leg& b) { return a.start >= b.start; };
    if (std::adjacent_find(legs.begin(), legs.end(), is_late) != legs.end()) {
        throw std::invalid_argument(
            "recorded legs: each leg has to begin later than the leg before");
    }
    for (std::size_t i = 0; i + 1 < legs.size(); ++i) {
        const Time end = legs[i + 1].start;
        if (legs[i].end <= end) continue;
        legs[i].to = legs[i].position(end);
        legs[i].end = end;
    }
    legs_ = std::make_shared<const std::vector<Leg>>(std::move(legs));
}

Step RecordedLegs::next_leg(Mover& mover) {
    const std::vector<Leg>& legs = *legs_;
    // A robot that was switched off has skipped the legs of that time.
    while (next_ + 1 < legs.size() && legs[next_ + 1].start <= mover.now) ++next_;
    if (next_ == legs.size() || legs[next_].end <= mover.now) return AtRest{};
    Leg leg = legs[next_];
    if (leg.start > mover.now) {
        Leg rest = standing_leg(mover);
        rest.end = leg.start;
        return rest;
    }
    ++next_;
    if (leg.start < mover.now) {
        leg.from = leg.position(mover.now);
        leg.heading = leg.heading_at(mover.now);
        leg.start = mover.now;
    }
    return leg;
}

}  // namespace rovernet
