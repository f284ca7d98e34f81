// SPDX-License-Identifier: MIT
#include "mobility/pursuit.hpp"

#include "sim/legs.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace rovernet {

Vec3 foreseen(const Mover& mover, NodeId leader, Time t, std::string_view model) {
    if (leader.index() >= mover.legs.size()) {
        throw std::invalid_argument(fmt::format("{}: leader must be one of the {} robots, got {}",
                                                model, mover.legs.size(), leader.value));
    }
    const Vec3 place = mover.legs.position(leader, t);
    return {place.x, place.y, mover.position.z};
}

Leg cut_short(const Mover& mover, const Leg& leg, Time end) {
    if (leg.end <= end) return leg;
    const double part = seconds(end - leg.start) / seconds(leg.end - leg.start);
    return straight_leg(mover, leg.from + part * (leg.to - leg.from), end);
}

Leg moment(const Mover& mover) {
    return straight_leg(mover, mover.position, mover.now + Duration{1});
}

}  // namespace rovernet
