// SPDX-License-Identifier: MIT
#include "mobility/wander.hpp"

#include "mobility/area.hpp"
#include "mobility/look_round.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace rovernet {
namespace {

/// Free path [m] of the body straight ahead, up to `most`.
double free_way(const Mover& mover, double most) {
    const Vec3 far = mover.position + most * direction_of(mover.heading);
    return distance(mover.position, straight_stop(mover, far));
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
        chosen = farthest(look, mover);
    }
    return wrapped(static_cast<double>(chosen) * LookRound::step);
}

/// Beam with the most free space; if nothing is in range, all directions are equal.
std::size_t Wander::farthest(const LookRound& look, const Mover& mover) {
    const double most = *std::max_element(look.ways().begin(), look.ways().end());
    std::vector<std::size_t> equal;
    for (std::size_t beam = 0; beam < look.ways().size(); ++beam)
        if (look.way(beam) == most) equal.push_back(beam);
    if (equal.size() == 1) return equal.front();
    const double drawn = progress.draws.uniform(mover) * static_cast<double>(equal.size());
    return equal[std::min(static_cast<std::size_t>(drawn), equal.size() - 1)];
}

Step Wander::next_leg(Mover& mover) {
    auto& [begun, has_turned, draws] = progress;
    if (!begun) {
        check_fields(*this, name);
        if (mover.scene().open_field())
            throw std::invalid_argument(
                "wander: the scene has no map, so there is nothing to avoid; expected a scene with "
                "a map");
        begun = true;
    }
    if (has_turned) {
        has_turned = false;
        const double free = free_way(mover, run.value + keep.value);
        // In a place too narrow for `keep` the robot moves half of the free length.
        const double way = free > keep.value + least_leg ? free - keep.value : free / 2;
        if (way > least_leg) {
            const Vec3 to = mover.position + way * direction_of(mover.heading);
            return straight_leg(mover, to, speed);
        }
    }
    has_turned = true;
    const double angle = turn(mover);
    const Duration time = std::max(from_seconds(std::abs(angle) / turn_rate.value), shortest_look);
    Leg leg = standing_leg(mover);
    leg.turning = angle / seconds(time);
    leg.end = mover.now + time;
    return leg;
}

}  // namespace rovernet
