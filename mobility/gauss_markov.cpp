// SPDX-License-Identifier: MIT
#include "mobility/gauss_markov.hpp"

#include "mobility/area.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rovernet {
namespace {

constexpr double half_turn = 3.141592653589793;  // [rad]

/// `angle` or a whole number of turns more or less: what is nearest to `other` [rad].
double nearest_turn(double angle, double other) {
    const double whole_turn = 2 * half_turn;
    return angle + whole_turn * std::floor((other - angle) / whole_turn + 0.5);
}

double to_middle(const Area& field, Vec3 p) {
    const Vec3 way = field.middle() - p;
    return math::atan2(way.y, way.x);
}

}  // namespace

void GaussMarkov::begin(const Mover& mover) {
    auto& [begun, draws, speed, direction, mean] = progress;
    mean = mean_direction ? mean_direction->value : 2 * half_turn * draws.uniform(mover);
    speed = mean_speed.value + speed_sigma.value * draws.normal(mover);
    direction = mean + direction_sigma.value * draws.normal(mover);
}

void GaussMarkov::advance(const Mover& mover, const Area& field) {
    auto& [begun, draws, speed, direction, mean] = progress;
    constexpr double margin = 0.1;  // of the shorter side
    if (field.to_border(mover.position) < margin * field.shorter_side()) {
        mean = nearest_turn(to_middle(field, mover.position), direction);
    }
    const double a = memory;
    const double fresh = std::sqrt(1 - a * a);
    speed =
        a * speed + (1 - a) * mean_speed.value + fresh * speed_sigma.value * draws.normal(mover);
    direction =
        a * direction + (1 - a) * mean + fresh * direction_sigma.value * draws.normal(mover);
}

void GaussMarkov::turn_to_middle(const Area& field, Vec3 p) {
    progress.mean_direction = to_middle(field, p);
    progress.direction = progress.mean_direction + (progress.speed < 0 ? half_turn : 0);
}

void GaussMarkov::turn_round() {
    const double turn = progress.mean_direction > 0 ? -half_turn : half_turn;  // keeps it small
    progress.direction += turn;
    progress.mean_direction += turn;
}

Step GaussMarkov::next_leg(Mover& mover) {
    constexpr int most_steps = 1000;
    if (!progress.begun) check_fields(*this, name);
    const Area field(area, mover.scene(), name);
    Mover at = mover;
    const bool first = !std::exchange(progress.begun, true);
    if (first) {
        const auto place = field.first_place(mover, start, progress.draws, name);
        if (!place) return Blocked{field.middle()};
        at.position = *place;
        begin(at);
    }
    for (int i = 0; i < most_steps; ++i) {
        if (!first || i > 0) advance(at, field);
        const double top = at.top_speed.value;
        const double v = std::clamp(progress.speed, -top, top);
        const Vec3 heading = (v < 0 ? -1.0 : 1.0) * direction_of(progress.direction);
        const Vec3 to = at.position + std::abs(v) * seconds(step) * heading;
        const bool inside = field.contains(to);
        const Vec3 end = inside ? to : field.exit(at.position, heading);
        const Vec3 stop = straight_stop(at, end);
        if (inside && stop == to) return straight_leg(at, to, at.now + step);
        if (stop == end)
            turn_to_middle(field, stop);
        else
            turn_round();
        if (distance(at.position, stop) > least_leg) {
            return straight_leg(at, stop, MetersPerSecond{std::abs(v)});
        }
    }
    return Blocked{at.position};
}

}  // namespace rovernet
