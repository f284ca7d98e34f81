// SPDX-License-Identifier: MIT
#include "mobility/random_direction.hpp"

#include "mobility/area.hpp"
#include "mobility/speed_range.hpp"

#include <cmath>
#include <utility>

namespace rovernet {
namespace {

/// Inward normal of the border on which `p` lies; zero if it lies on none.
Vec3 inward_normal(const Area& field, Vec3 p) {
    if (p.x == field.lower.x) return {1, 0, 0};
    if (p.x == field.upper.x) return {-1, 0, 0};
    if (p.y == field.lower.y) return {0, 1, 0};
    if (p.y == field.upper.y) return {0, -1, 0};
    return {};
}

}  // namespace

Vec3 RandomDirection::new_direction(const Mover& mover, const Area& field) {
    const Vec3 normal = inward_normal(field, mover.position);
    if (border_turn == BorderTurn::uniform || normal == Vec3{}) {
        return any_direction(mover, progress.draws);
    }
    const double sin = 2 * progress.draws.uniform(mover) - 1;
    return std::sqrt(1 - sin * sin) * normal + sin * Vec3{-normal.y, normal.x, 0};
}

Step RandomDirection::next_leg(Mover& mover) {
    constexpr int most_directions = 1000;
    auto& [begun, rested, draws] = progress;
    if (!begun) check_fields(*this, name);
    const Area field(area, mover.scene(), name);
    const SpeedRange speeds(min_speed, max_speed, mover, name);
    Mover at = mover;
    const bool first = !std::exchange(begun, true);
    if (first) {
        const auto place = field.first_place(mover, start, draws, name);
        if (!place) return Blocked{field.middle()};
        at.position = *place;
    } else if (!std::exchange(rested, true) && pause > Duration{0}) {
        return straight_leg(mover, mover.position, mover.now + pause);
    }
    const double u = draws.uniform(mover);
    const double speed = first && speeds.low > 0 ? speeds.at_a_moment(u) : speeds.of_a_trip(u);
    for (int i = 0; i < most_directions; ++i) {
        const Vec3 to = straight_stop(at, field.exit(at.position, new_direction(at, field)));
        if (distance(at.position, to) <= least_leg) continue;
        rested = false;
        return straight_leg(at, to, MetersPerSecond{speed});
    }
    return Blocked{at.position};
}

}  // namespace rovernet
