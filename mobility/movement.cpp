// SPDX-License-Identifier: MIT
#include "mobility/movement.hpp"

#include "sim/math.hpp"

#include <algorithm>

namespace rovernet {
namespace {

constexpr double longest_s = 9e8;  // 28 years: beyond any run, within the clock

/// `s` seconds after now, at least a nanosecond.
Time after(const Mover& mover, double s) {
    return mover.now + std::max(from_seconds(std::min(s, longest_s)), Duration{1});
}

Leg leg_until(const Mover& mover, Vec3 to, Time arrival) {
    const Vec3 way = to - mover.position;
    return {.start = mover.now,
            .end = arrival,
            .from = mover.position,
            .velocity = (1 / seconds(arrival - mover.now)) * way,
            .to = to,
            .heading = way.x == 0 && way.y == 0 ? mover.heading : math::atan2(way.y, way.x)};
}

}  // namespace

Leg straight_leg(const Mover& mover, Vec3 to, MetersPerSecond speed) {
    const double v = std::min(speed, mover.top_speed).value;
    return leg_until(mover, to, after(mover, distance(mover.position, to) / v));
}

Leg straight_leg(const Mover& mover, Vec3 to, Time arrival) {
    const Time soonest = after(mover, distance(mover.position, to) / mover.top_speed.value);
    return leg_until(mover, to, std::max(arrival, soonest));
}

}  // namespace rovernet
