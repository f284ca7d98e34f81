// SPDX-License-Identifier: MIT
#include "mobility/follow_wall.hpp"

#include "mobility/area.hpp"
#include "mobility/look_round.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace rovernet {
namespace {

constexpr double quarter = std::numbers::pi / 2;

/// Leg along `direction` as far as the body can move; the direction is turned away from the wall by
/// `away` [rad] until it is free, otherwise the direction with the longest free path is used.
Step leg_along(const Mover& mover, double direction, double way, MetersPerSecond speed,
               double away) {
    constexpr double enough = 1.0 / 16;  // of the way
    Vec3 farthest = mover.position;
    for (double turned = 0; turned < 2 * std::numbers::pi; turned += std::abs(away)) {
        const double at = direction + std::copysign(turned, away);
        const Vec3 to = straight_stop(mover, mover.position + way * direction_of(at));
        if (distance(mover.position, to) > enough * way) return straight_leg(mover, to, speed);
        if (distance(mover.position, to) > distance(mover.position, farthest)) farthest = to;
    }
    const double left = distance(mover.position, farthest);
    if (left <= least_leg) return Blocked{mover.position};
    const Duration time = std::max(from_seconds(left / speed.value), shortest_look);
    return straight_leg(mover, farthest, mover.now + time);
}

}  // namespace

Step FollowWall::next_leg(Mover& mover) {
    if (!progress.begun) {
        check_fields(*this, name);
        if (mover.scene().open_field())
            throw std::invalid_argument(
                "follow_wall: the scene has no map, so there is no wall to follow; expected a "
                "scene with a map");
        progress.begun = true;
    }
    const double sign = side == WallSide::left ? 1 : -1;  // of the turn to the wall
    const double away = -sign * 15 * LookRound::step;
    double gap = keep.value + mover.radius.value;  // from its middle to the wall
    const LookRound look(mover, range);
    const auto wall = look.nearest(side == WallSide::left);
    if (!wall) {
        const double way = std::max(stride.value, (range.value - gap) / 2);
        return leg_along(mover, mover.heading, way, speed, away);
    }
    const double across = look.way_towards(look.direction(*wall) + 2 * quarter);
    if (across < range.value) gap = std::min(gap, (look.way(*wall) + across) / 2);  // a narrow way
    const double error = look.way(*wall) - gap;
    const double to_wall = math::atan2(error, stride.value);
    const double along = look.direction(*wall) - sign * (quarter - to_wall);
    const double most = std::max(stride.value, error / 2);
    const double ahead = look.way_towards(along);
    const double before_next = ahead < range.value ? ahead - gap : most;  // to the wall at a corner
    if (before_next > least_leg)
        return leg_along(mover, along, std::min(most, before_next), speed, away);
    return leg_along(mover, along - sign * quarter, stride.value, speed, away);
}

}  // namespace rovernet
