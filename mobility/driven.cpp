// SPDX-License-Identifier: MIT
#include "mobility/driven.hpp"

#include "mobility/area.hpp"
#include "scene/contact.hpp"
#include "scene/scene.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

namespace rovernet {
namespace {

constexpr double longest_leg = 1e6;  // [s]

/// Duration of a chord [ns] for which the arc is at most `chord` from it: an arc of radius v / w
/// deviates by at most |v w| t^2 / 8. No chord spans more than a quarter of the circle.
Duration chord_time(double v, double w, double chord) {
    constexpr double quarter = 1.5707963267948966;  // [rad]
    const double t = std::min(std::sqrt(8 * chord / std::abs(v * w)), quarter / std::abs(w));
    return std::max(from_seconds(std::min(t, longest_leg)), Duration{1});
}

/// Length [m] of a straight path from p, in any direction, that ends off the map.
double beyond_map(const Scene& scene, Vec3 p) {
    const Vec3 low = scene.lower_left(), high = scene.upper_right(), size = high - low;
    const double x = std::max({0.0, low.x - p.x, p.x - high.x});
    const double y = std::max({0.0, low.y - p.y, p.y - high.y});
    return 1 + std::sqrt(size.x * size.x + size.y * size.y) + std::sqrt(x * x + y * y);
}

/// Time until the end of the next chord, or of the straight path; empty if it is endless.
std::optional<Duration> time_ahead(const Mover& mover, double v, double w, double chord, Time end) {
    Duration time = end == never ? Duration::max() : end - mover.now;
    if (w != 0) return std::min(time, chord_time(v, w, chord));
    if (!mover.scene().open_field()) {
        const double t = beyond_map(mover.scene(), mover.position) / std::abs(v);
        return std::min(time, std::max(from_seconds(std::min(t, longest_leg)), Duration{1}));
    }
    return end == never ? std::nullopt : std::optional(time);
}

/// Position on the arc at which a command starts: the robot's position, or the point of the
/// previous command's arc if the robot is on one of its chords.
Vec3 place_on(const DrivenArc* arc, const Mover& mover, double chord) {
    if (!arc) return mover.position;
    const Vec3 place = arc->position(mover.now);
    return distance(place, mover.position) <= chord ? place : mover.position;
}

/// Angle by which the heading `way` [rad] has to turn, in the direction of `sign`, until it points
/// away from all contacts; 0 if it does now; infinity if there is none.
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

/// Duration of the longest free chord of the arc, at most `time`, from the robot's position; 0 if
/// the chord is shorter than a least_leg.
Duration free_time(const Mover& mover, const DrivenArc& arc, Duration time) {
    const Scene& scene = mover.scene();
    const auto open = [&](double share) {
        const Vec3 to = arc.position(arc.since + from_seconds(share * seconds(time)));
        return scene.inside_map(to) && scene.passable(mover.position, to, mover.radius);
    };
    const double off = least_leg / (std::abs(arc.speed) * seconds(time));
    return from_seconds(free_share(open, off) * seconds(time));
}

/// Leg on a straight path that ends at `to`.
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
    // A chord that begins beside the arc is half as long, so that it is nowhere farther off than at
    // its start.
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
        // The robot is blocked and turns until its heading points away from the contacts.
        const double held = std::ceil(1e9 * (to_turn / std::abs(ahead.turn_rate)));  // [ns]
        if (held < 1e9 * longest_leg) {
            leg.end = std::min(leg.end, mover.now + Duration{static_cast<std::int64_t>(held)});
        }
        return leg;
    }
    leg.end = mover.now + time;
    const Duration free = free_time(mover, ahead, time);
    if (free <= Duration{0}) return leg;  // it turns by a chord, and looks again
    leg.end = mover.now + free;
    if (arc) *arc = ahead;
    return ended_at(leg, ahead.position(leg.end));
}

}  // namespace rovernet
