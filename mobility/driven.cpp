// SPDX-License-Identifier: MIT
#include "mobility/driven.hpp"

#include "mobility/area.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

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

/// Angle by which the direction `way` [rad] has to turn, in the sense of `sign`, until it points
/// off everything that the robot touches; 0 if it does now; infinity if none does.
double turn_off(const std::vector<Contact>& contacts, double way, double sign) {
    constexpr double rounding = 1e-9;  // [rad]
    double turned = 0;
    for (bool is_blocked = true; is_blocked && turned < 2 * std::numbers::pi;) {
        is_blocked = false;
        for (const Contact& each : contacts) {
            const double off = sign * wrapped(way - each.towards) + turned;
            const double beyond = std::remainder(off, 2 * std::numbers::pi) + each.half_angle;
            if (beyond < 0 || beyond > 2 * each.half_angle - rounding) continue;
            is_blocked = true;
            turned += 2 * each.half_angle - beyond;
        }
    }
    return turned < 2 * std::numbers::pi ? turned : std::numeric_limits<double>::infinity();
}

/// Time [s] of the longest part of the arc, of at most `time`, whose chord the robot's body can go
/// from where it is; 0 if that is shorter than a least_leg.
double free_time(const Mover& mover, const DrivenArc& arc, Duration time) {
    const Scene& scene = mover.scene();
    const auto open = [&](double t) {
        const Vec3 to = arc.position(arc.since + from_seconds(t));
        return scene.inside_map(to) && scene.passable(mover.position, to, mover.radius);
    };
    if (open(seconds(time))) return seconds(time);
    double good = 0, bad = seconds(time);
    constexpr int halvings = 40;
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (good + bad);
        (open(middle) ? good : bad) = middle;
    }
    const double off = least_leg / std::abs(arc.speed);
    return good - off >= off && open(good - off) ? good - off : 0;
}

/// The leg on a straight way to `to`, where it ends.
Leg ended_at(Leg leg, Vec3 to) {
    leg.to = to;
    leg.velocity = (1 / seconds(leg.end - leg.start)) * (to - leg.from);
    return leg;
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

    const DrivenArc ahead{mover.now, begin, mover.heading, v, w};
    // A chord that begins beside the arc is half as long: it is nowhere farther off than it began.
    const double off = begin == mover.position ? 1 : 0.25;
    const std::optional<Duration> time = time_ahead(mover, v, w, off * chord.value, end);
    if (!time) {
        const auto [sin, cos] = math::sincos(mover.heading);
        leg.velocity = v * Vec3{cos, sin, 0};
        if (arc) *arc = ahead;
        return leg;
    }
    return w == 0 ? straight_ahead(mover, ahead, *time, leg) : along_arc(mover, ahead, *time, leg);
}

Leg Driven::straight_ahead(const Mover& mover, const DrivenArc& ahead, Duration time, Leg leg) {
    const Vec3 to = ahead.position(mover.now + time), stop = straight_stop(mover, to);
    if (stop == mover.position) return leg;  // it stands there
    leg.end = mover.now + time;
    if (stop != to) {
        const double share = distance(mover.position, stop) / distance(mover.position, to);
        leg.end = mover.now + std::max(from_seconds(share * seconds(time)), Duration{1});
    } else if (arc) {
        *arc = ahead;
    }
    return ended_at(leg, stop);
}

Leg Driven::along_arc(const Mover& mover, const DrivenArc& ahead, Duration time, Leg leg) {
    const double way = ahead.speed > 0 ? ahead.heading : ahead.heading + std::numbers::pi;
    const auto contacts = mover.scene().contacts(mover.position, mover.radius);
    const double to_turn = turn_off(contacts, way, ahead.turn_rate > 0 ? 1 : -1);
    if (to_turn > 0) {
        // Held by what it touches, it turns until it points off that.
        const double held = std::ceil(1e9 * (to_turn / std::abs(ahead.turn_rate)));  // [ns]
        if (held < 1e9 * longest_leg) {
            leg.end = std::min(leg.end, mover.now + Duration{static_cast<std::int64_t>(held)});
        }
        return leg;
    }
    leg.end = mover.now + time;
    const Duration free = from_seconds(free_time(mover, ahead, time));
    if (free <= Duration{0}) return leg;  // it turns by a chord, and looks again
    leg.end = mover.now + free;
    if (arc) *arc = ahead;
    return ended_at(leg, ahead.position(leg.end));
}

}  // namespace rovernet
