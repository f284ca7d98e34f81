// SPDX-License-Identifier: MIT
#include "mobility/random_walk.hpp"

#include "mobility/area.hpp"
#include "mobility/speed_range.hpp"

#include <utility>

namespace rovernet {
namespace {

/// Direction, reflected in each coordinate in which it points out of the area.
Vec3 reflected(Vec3 direction, const Area& field, Vec3 p) {
    const bool left = p.x <= field.lower.x && direction.x < 0;
    const bool right = p.x >= field.upper.x && direction.x > 0;
    const bool below = p.y <= field.lower.y && direction.y < 0;
    const bool above = p.y >= field.upper.y && direction.y > 0;
    return {left || right ? -direction.x : direction.x, below || above ? -direction.y : direction.y,
            0};
}

}  // namespace

void RandomWalk::begin_step(const Mover& mover, const SpeedRange& speeds) {
    progress.direction = any_direction(mover, progress.draws);
    progress.speed = {speeds.of_a_trip(progress.draws.uniform(mover))};
    progress.step_end = mover.now + step;
}

Step RandomWalk::next_leg(Mover& mover) {
    constexpr int most_steps = 1000;
    auto& [begun, draws, step_end, direction, speed] = progress;
    if (!begun) check_fields(*this, name);
    const Area field(area, mover.scene(), name);
    const SpeedRange speeds(min_speed, max_speed, mover, name);
    Mover at = mover;
    if (!std::exchange(begun, true)) {
        const auto place = field.first_place(mover, start, draws, name);
        if (!place) return Blocked{field.middle()};
        at.position = *place;
    }
    for (int i = 0; i < most_steps; ++i) {
        if (step_end <= at.now) begin_step(at, speeds);
        direction = reflected(direction, field, at.position);
        const Vec3 border = field.exit(at.position, direction);
        const double left = speed.value * seconds(step_end - at.now);
        const bool bounces = distance(at.position, border) <= left;
        const Vec3 to = bounces ? border : field.clamped(at.position + left * direction);
        const Vec3 stop = straight_stop(at, to);
        if (stop == to)
            return bounces ? straight_leg(at, to, speed) : straight_leg(at, to, step_end);
        step_end = at.now;
        if (distance(at.position, stop) > least_leg) return straight_leg(at, stop, speed);
    }
    return Blocked{at.position};
}

}  // namespace rovernet
