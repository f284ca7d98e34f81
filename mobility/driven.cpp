// SPDX-License-Identifier: MIT
#include "mobility/driven.hpp"

#include "mobility/area.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace rovernet {
namespace {

constexpr double longest_leg = 1e6;  // [s]

/// Time that a chord may take [ns] so that the arc is nowhere farther from it than `chord`: an arc
/// of radius v / w is |v w| t^2 / 8 away at most. No chord spans more than a quarter of the circle.
Duration chord_time(double v, double w, double chord) {
    constexpr double quarter = 1.5707963267948966;  // [rad]
    const double t = std::min(std::sqrt(8 * chord / std::abs(v * w)), quarter / std::abs(w));
    return std::max(from_seconds(std::min(t, longest_leg)), Duration{1});
}

/// Far enough ahead to leave any map from anywhere on it [m].
double beyond_map(const Scene& scene) {
    const Vec3 size = scene.upper_right() - scene.lower_left();
    return 1 + std::hypot(size.x, size.y);
}

/// Time until the end of the next chord, or of the straight way; nothing: it goes on for ever.
std::optional<Duration> time_ahead(const Mover& mover, double v, double w, double chord, Time end) {
    Duration time = end == never ? Duration::max() : end - mover.now;
    if (w != 0) return std::min(time, chord_time(v, w, chord));
    if (!mover.scene().open_field()) {
        const double t = beyond_map(mover.scene()) / std::abs(v);
        return std::min(time, std::max(from_seconds(std::min(t, longest_leg)), Duration{1}));
    }
    return end == never ? std::nullopt : std::optional(time);
}

/// Place on the arc where a command takes the robot over: where the robot is, unless it is on a
/// chord of the command before.
Vec3 place_on(const DrivenArc* arc, const Mover& mover, double chord) {
    if (!arc) return mover.position;
    const Vec3 place = arc->position(mover.now);
    return distance(place, mover.position) <= chord ? place : mover.position;
}

}  // namespace

Vec3 DrivenArc::position(Time t) const {
    const double time = seconds(t - since);
    const double half = turn_rate * time / 2;
    const auto [sin, cos] = math::sincos(heading + half);
    const double share = half == 0 ? 1 : math::sincos(half).sin / half;
    return at + share * speed * time * Vec3{cos, sin, 0};
}

Step Driven::next_leg(Mover& mover) {
    Leg leg = standing_leg(mover);
    const Time end = until.value_or(never);
    const Vec3 begin = place_on(arc.get(), mover, chord.value);
    if (arc) *arc = {mover.now, begin, mover.heading, 0, 0};
    if (mover.now >= end) return leg;
    const double top = mover.top_speed.value;
    const double v = std::clamp(speed.value, -top, top), w = turn_rate.value;
    leg.turning = w;
    leg.end = end;
    if (v == 0) return leg;

    // A chord that begins beside the arc is half as long: it is nowhere farther off than it began.
    const double off = begin == mover.position ? 1 : 0.25;
    const std::optional<Duration> time = time_ahead(mover, v, w, off * chord.value, end);
    const DrivenArc ahead{mover.now, begin, mover.heading, v, w};
    if (!time) {
        const auto [sin, cos] = math::sincos(mover.heading);
        leg.velocity = v * Vec3{cos, sin, 0};
        if (arc) *arc = ahead;
        return leg;
    }
    leg.end = mover.now + *time;
    const Vec3 to = ahead.position(leg.end);
    const Vec3 stop = straight_stop(mover, to);
    if (stop == mover.position) {
        if (w == 0) leg.end = end;  // it stands there
        return leg;
    }
    if (stop == to) {
        if (arc) *arc = ahead;
    } else {
        const double share = distance(mover.position, stop) / distance(mover.position, to);
        leg.end = mover.now + std::max(from_seconds(share * seconds(*time)), Duration{1});
    }
    leg.to = stop;
    leg.velocity = (1 / seconds(leg.end - mover.now)) * (stop - mover.position);
    return leg;
}

}  // namespace rovernet
