// SPDX-License-Identifier: MIT
#include "scene/closed_doors.hpp"
// Robots at doors that close and open.
#include "network/motion.hpp"
#include "network/world.hpp"
#include "scene/doors.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace rovernet {
namespace {

/// End of a leg, for the check of doors; an endless leg counts as longer than any map.
Vec3 end_of(const Leg& leg) {
    constexpr double longest = 1e6;  // [s]
    return leg.end == never ? leg.from + longest * leg.velocity : leg.to;
}

/// Leg of the same duration that starts now.
Leg begun_at(Leg leg, Time now) {
    if (leg.end != never) leg.end += now - leg.start;
    leg.start = now;
    return leg;
}

}  // namespace

bool Motion::is_caught(NodeId id) {
    if (!world_.doors || nodes_[id.index()].movement.at_doors() == AtDoors::passes) return false;
    const Vec3 here = world_.legs.position(id, world_.now);
    return !world_.doors->passable(here, here, body(id).radius);
}

bool Motion::is_held(NodeId id) {
    if (nodes_[id.index()].moving && is_caught(id)) {
        held_.try_emplace(id);
        take(id, standing_leg(mover(id)));
        return true;
    }
    if (!held_.contains(id)) return false;
    go_on(id);
    return true;
}

bool Motion::is_free(NodeId id) {
    if (is_caught(id)) return false;
    const auto held = held_.find(id);
    if (!world_.doors || held == held_.end() || !held->second) return true;
    const Leg& rest = *held->second;
    return world_.doors->stop(rest.from, end_of(rest), body(id).radius) != rest.from;
}

bool Motion::waits(NodeId id) const {
    return held_.contains(id) && world_.legs.leg(id).velocity == Vec3{};
}

Leg Motion::rest_of(NodeId id, const Leg& leg) {
    Leg rest = leg;
    rest.start = world_.now;
    rest.from = world_.legs.position(id, world_.now);
    rest.heading = wrapped(world_.legs.leg(id).heading_at(world_.now));
    const auto behind = held_.extract(id);
    if (!behind || !behind.mapped()) return rest;
    rest.end += behind.mapped()->end - behind.mapped()->start;
    rest.to = behind.mapped()->to;
    return rest;
}

void Motion::go_to_doors(NodeId id, const Leg& leg) {
    const AtDoors at_doors = nodes_[id.index()].movement.at_doors();
    if (leg.velocity == Vec3{} || at_doors == AtDoors::passes) return take(id, leg);
    const Vec3 to = end_of(leg);
    const auto stop = world_.doors->stop(leg.from, to, body(id).radius);
    if (!stop) return take(id, leg);
    Leg rest = leg, standing = standing_leg(mover(id));
    if (at_doors != AtDoors::waits) standing.end = leg.end;  // then it is asked again
    if (*stop != leg.from) {
        const double share = distance(leg.from, *stop) / distance(leg.from, to);
        const Duration all =
            leg.end == never ? from_seconds(distance(leg.from, to) / distance(Vec3{}, leg.velocity))
                             : leg.end - leg.start;
        Leg before = leg;
        before.to = rest.from = *stop;
        before.end = rest.start =
            leg.start + std::max(from_seconds(share * seconds(all)), Duration{1});
        rest.heading = wrapped(before.heading_at(before.end));
        if (rest.end <= rest.start) rest.end = rest.start + Duration{1};
        standing = before;
    }
    if (at_doors == AtDoors::waits) held_[id] = rest;
    take(id, standing);
}

void Motion::go_on(NodeId id) {
    const std::optional<Leg> rest = std::move(held_.extract(id).mapped());
    if (rest) return go(id, begun_at(*rest, world_.now));
    next_leg(id);
}

void Motion::scene_changed() {
    // Robots whose legs change, in the order of their keys, so that the order of adding robots has
    // no effect.
    std::vector<NodeId> changed;
    for (NodeId id{0}; id.index() < begun_; ++id.value) {
        const AtDoors at_doors = nodes_[id.index()].movement.at_doors();
        if (at_doors == AtDoors::passes || !world_.medium.stations().is_on(id)) continue;
        const Leg leg = world_.legs.leg(id);
        const bool moves = leg.velocity != Vec3{};
        const Vec3 here = world_.legs.position(id, world_.now);
        const bool stops =
            moves && world_.doors && !world_.doors->passable(here, end_of(leg), body(id).radius);
        const bool stands = !moves && (waits(id) || at_doors == AtDoors::drives);
        if (stops || (stands && is_free(id))) changed.push_back(id);
    }
    std::sort(changed.begin(), changed.end(),
              [this](NodeId a, NodeId b) { return world_.key(a) < world_.key(b); });
    for (const NodeId id : changed) {
        const Leg leg = world_.legs.leg(id);
        if (leg.velocity != Vec3{}) {
            go(id, rest_of(id, leg));
        } else {
            waits(id) ? go_on(id) : next_leg(id);
        }
    }
}

}  // namespace rovernet
