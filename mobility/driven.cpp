// SPDX-License-Identifier: MIT
#include "mobility/driven.hpp"

#include "mobility/area.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <cmath>

namespace rovernet {
namespace {

/// Time that a chord may take [ns] so that the arc is nowhere farther from it than `chord`: an arc
/// of radius v / w is |v w| t^2 / 8 away at most. No chord spans more than a quarter of the circle.
Duration chord_time(double v, double w, double chord) {
    constexpr double quarter = 1.5707963267948966;  // [rad]
    const double t = std::min(std::sqrt(8 * chord / std::abs(v * w)), quarter / std::abs(w));
    return std::max(from_seconds(t), Duration{1});
}

/// Far enough ahead to leave any map from anywhere on it [m].
double beyond_map(const Scene& scene) {
    const Vec3 size = scene.upper_right() - scene.lower_left();
    return 1 + std::hypot(size.x, size.y);
}

}  // namespace

Step Driven::next_leg(Mover& mover) {
    Leg leg = standing_leg(mover);
    const Time end = until.value_or(never);
    if (mover.now >= end) return leg;
    const double top = mover.top_speed.value;
    const double v = std::clamp(speed.value, -top, top), w = turn_rate.value;
    leg.turning = w;
    leg.end = end;
    if (v == 0) return leg;

    // End of the chord, and time until then.
    const auto [sin, cos] = math::sincos(mover.heading);
    Duration time = end == never ? Duration::max() : end - mover.now;
    Vec3 way;
    if (w == 0) {
        const bool is_open = mover.scene().open_field();
        if (is_open && end == never) {
            leg.velocity = v * Vec3{cos, sin, 0};
            return leg;
        }
        if (!is_open) time = std::min(time, from_seconds(beyond_map(mover.scene()) / std::abs(v)));
        way = v * seconds(time) * Vec3{cos, sin, 0};
    } else {
        time = std::min(time, chord_time(v, w, chord.value));
        const auto [sin_then, cos_then] = math::sincos(mover.heading + w * seconds(time));
        way = v / w * Vec3{sin_then - sin, cos - cos_then, 0};
    }

    const Vec3 to = mover.position + way;
    const Vec3 stop = straight_stop(mover, to);
    leg.end = mover.now + time;
    if (stop == mover.position) {
        if (w == 0) leg.end = end;  // it stands there
        return leg;
    }
    if (stop != to) {
        const double share = distance(mover.position, stop) / distance(mover.position, to);
        leg.end = mover.now + std::max(from_seconds(share * seconds(time)), Duration{1});
    }
    leg.to = stop;
    leg.velocity = (1 / seconds(leg.end - mover.now)) * (stop - mover.position);
    return leg;
}

}  // namespace rovernet
