// SPDX-License-Identifier: MIT
#include "mobility/movement.hpp"

#include "mobility/planners.hpp"
#include "scene/scene.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <optional>

namespace rovernet {
namespace {

constexpr double last_s = 9.2e9;  // 291 years: beyond any run, within the clock

/// Time `s` seconds after now, at least a nanosecond; empty if it is beyond every run.
std::optional<Time> after(const Mover& mover, double s) {
    if (!(s < last_s - seconds(mover.now))) return std::nullopt;
    return mover.now + std::max(from_seconds(s), Duration{1});
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

/// Part of the path to `to` that the mover travels before the clock ends.
Leg endless_leg(const Mover& mover, Vec3 to, MetersPerSecond speed) {
    const Time end = start_of_run + from_seconds(last_s);
    const double share = speed.value * seconds(end - mover.now) / distance(mover.position, to);
    return leg_until(mover, mover.position + share * (to - mover.position), end);
}

}  // namespace

const Scene& Mover::scene() const {
    return (scene_now ? *scene_now : planners.scene()).storey_at(position.z);
}

Leg straight_leg(const Mover& mover, Vec3 to, MetersPerSecond speed) {
    const MetersPerSecond v = std::min(speed, mover.top_speed);
    const auto arrival = after(mover, distance(mover.position, to) / v.value);
    return arrival ? leg_until(mover, to, *arrival) : endless_leg(mover, to, v);
}

Leg straight_leg(const Mover& mover, Vec3 to, Time arrival) {
    const auto soonest = after(mover, distance(mover.position, to) / mover.top_speed.value);
    if (!soonest) return endless_leg(mover, to, mover.top_speed);
    return leg_until(mover, to, std::max(arrival, *soonest));
}

}  // namespace rovernet
