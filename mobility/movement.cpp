// SPDX-License-Identifier: MIT
#include "mobility/movement.hpp"

#include <algorithm>

namespace rovernet {

Leg straight_leg(const Mover& mover, Vec3 to, MetersPerSecond speed) {
    constexpr double longest_s = 9e8;  // 28 years: beyond any run, within the clock
    const double s = std::min(distance(mover.position, to) / speed.value, longest_s);
    return straight_leg(mover, to, mover.now + std::max(from_seconds(s), Duration{1}));
}

Leg straight_leg(const Mover& mover, Vec3 to, Time arrival) {
    return {.start = mover.now,
            .end = arrival,
            .from = mover.position,
            .velocity = (1 / seconds(arrival - mover.now)) * (to - mover.position),
            .to = to};
}

}  // namespace rovernet
