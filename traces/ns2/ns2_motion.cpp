// SPDX-License-Identifier: MIT
#include "traces/ns2/ns2_motion.hpp"

#include "sim/math.hpp"

#include <algorithm>
#include <cmath>

namespace rovernet {
namespace {

bool is_same_place(Vec3 a, Vec3 b) {
    constexpr double half_a_centimetre = 0.005;
    return distance(a, b) < half_a_centimetre;
}

Leg rest_at(Vec3 place, Time start) {
    return {.start = start, .end = never, .from = place, .velocity = {}, .to = place};
}

Leg straight_between(Vec3 from, Time start, Vec3 to, Time end) {
    return {.start = start,
            .end = end,
            .from = from,
            .velocity = (1 / seconds(end - start)) * (to - from),
            .to = to};
}

}  // namespace

Leg leg_of(const Ns2Move& m) {
    Leg leg{.start = m.time, .end = never, .from = m.from, .velocity = {}, .to = m.from};
    const double length = distance(m.from, m.to);
    if (!(m.speed > 0) || !(length > 0) || !std::isfinite(length)) return leg;
    leg.velocity = (m.speed / length) * (m.to - m.from);
    leg.to = m.to;
    constexpr double longest_s = 9e9;  // half of the clock's range: start + duration stays in it
    const double duration_s = length / m.speed;
    if (duration_s < longest_s && seconds(m.time) + duration_s < longest_s) {
        leg.end = m.time + from_seconds(duration_s);
    }
    return leg;
}

void Ns2Motion::Track::begin(Vec3 place) {
    is_known = true;
    plan = rest_at(place, start_of_run);
    told = start_of_run;
}

/// Whether the robot rests at that position according to the plan.
bool Ns2Motion::Track::rests_at(Vec3 place, Time time) const {
    const bool rests = plan.velocity == Vec3{} || time >= plan.end;
    return rests && is_same_place(place, plan.to);
}

/// Whether the robot moves by the plan, and rounding explains its distance from the position.
bool Ns2Motion::Track::explains(Vec3 place, Time time) const {
    constexpr double of_places = 0.02, of_speed = 0.005;  // [m], [m/s]
    return plan.velocity != Vec3{} && distance(plan.position(time), place) <=
                                          of_places + of_speed * seconds(time - plan.start);
}

/// The robot has reached a position on its planned path.
void Ns2Motion::Track::reach(Vec3 place, Time time) {
    past.push_back(straight_between(plan.from, plan.start, place, time));
    plan = is_same_place(place, plan.to)
               ? rest_at(plan.to, time)
               : leg_of({.time = time, .node = {}, .from = place, .to = plan.to, .speed = speed});
    told = time;
}

/// The robot has moved to a position that the plan does not explain.
void Ns2Motion::Track::appear(Vec3 place, Time time) {
    const bool was_told_before = told < time;
    if (told > plan.start) past.push_back(plan);
    if (was_told_before) past.push_back(straight_between(plan.position(told), told, place, time));
    plan = rest_at(place, time);
    told = time;
}

Ns2Motion::Track& Ns2Motion::track(NodeId node) {
    if (node.index() >= tracks_.size()) tracks_.resize(node.index() + 1);
    return tracks_[node.index()];
}

void Ns2Motion::begins(NodeId node, const Leg& leg) {
    Track& t = track(node);
    if (!t.is_known) t.begin(leg.from);
    // The times of M lines are rounded to 10 us: a packet line before one may be later.
    const Time time = std::max(leg.start, t.plan.start);
    if (time > t.plan.start) {
        const bool is_on_its_way = !t.rests_at(leg.from, time) && t.explains(leg.from, time);
        if (is_on_its_way) {
            t.reach(leg.from, time);
        } else {
            t.past.push_back(t.plan);
        }
    }
    t.plan = leg;
    t.plan.start = time;
    t.speed = std::sqrt(dot(leg.velocity, leg.velocity));
    t.told = time;
}

void Ns2Motion::is_at(NodeId node, Time time, Vec3 place) {
    Track& t = track(node);
    if (!t.is_known) t.begin(place);
    if (time - t.plan.start < apart) return;
    if (t.rests_at(place, time)) {
        t.told = std::max(t.told, time);
    } else if (t.explains(place, time)) {
        t.reach(place, time);
    } else {
        t.appear(place, time);
    }
}

std::vector<Leg> Ns2Motion::legs(NodeId node) const {
    if (!knows(node)) return {};
    const Track& t = tracks_[node.index()];
    std::vector<Leg> legs = t.past;
    legs.push_back(t.plan);
    double heading = 0;
    for (Leg& leg : legs) {
        if (leg.velocity != Vec3{}) heading = math::atan2(leg.velocity.y, leg.velocity.x);
        leg.heading = heading;
    }
    return legs;
}

}  // namespace rovernet
