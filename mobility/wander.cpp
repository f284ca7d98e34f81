// SPDX-License-Identifier: MIT
#include "mobility/wander.hpp"

#include "mobility/area.hpp"
#include "mobility/look_round.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace rovernet {
namespace {

/// Free way of the body ahead [m]: as far as `most`, less what it keeps.
double way_ahead(const Mover& mover, double heading, double most, double keep) {
    const Vec3 far = mover.position + (most + keep) * direction_of(heading);
    return std::min(most, distance(mover.position, straight_stop(mover, far)) - keep);
}

}  // namespace

double Wander::turn(const Mover& mover) {
    const LookRound look(mover, range);
    std::vector<double> weights;
    double sum = 0;
    for (const double free : look.ways()) {
        const double way = free - mover.radius.value;
        sum += weights.emplace_back(way > 2 * keep.value ? way : 0);
    }
    std::size_t chosen = 0;
    if (sum > 0) {
        double left = progress.draws.uniform(mover) * sum;
        while (chosen + 1 < weights.size() && left >= weights[chosen]) left -= weights[chosen++];
    } else {
        const auto farthest = std::max_element(look.ways().begin(), look.ways().end());
        chosen = static_cast<std::size_t>(farthest - look.ways().begin());
    }
    return wrapped(static_cast<double>(chosen) * LookRound::step);
}

Step Wander::next_leg(Mover& mover) {
    auto& [begun, has_turned, draws] = progress;
    if (!begun) {
        check_fields(*this, name);
        if (mover.scene().open_field())
            throw std::invalid_argument("wander: there is no map, so nothing to avoid");
        begun = true;
    }
    if (has_turned) {
        has_turned = false;
        const double way = way_ahead(mover, mover.heading, run.value, keep.value);
        if (way > least_leg) {
            const Vec3 to = mover.position + way * direction_of(mover.heading);
            return straight_leg(mover, to, speed);
        }
    }
    has_turned = true;
    const double angle = turn(mover);
    Leg leg = standing_leg(mover);
    leg.turning = std::copysign(turn_rate.value, angle);
    leg.end = mover.now + std::max(from_seconds(std::abs(angle) / turn_rate.value), Duration{1});
    return leg;
}

}  // namespace rovernet
