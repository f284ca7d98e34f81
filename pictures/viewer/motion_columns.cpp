// SPDX-License-Identifier: MIT
#include "pictures/viewer/motion_columns.hpp"

#include "pictures/viewer/column.hpp"
#include "pictures/viewer/view_file.hpp"

#include <algorithm>
#include <variant>

namespace rovernet {
namespace {

constexpr std::uint8_t not_departed = 4, left = 5;  // states

}  // namespace

void MotionColumns::begin(NodeId robot, Presence presence) {
    if (presence == Presence::on) return;
    const std::uint8_t what = presence == Presence::off    ? 0
                              : presence == Presence::left ? left
                                                           : not_departed;
    states_.push_back({whole_ns(start_of_run), robot.value, what});
}

void MotionColumns::on(const Record& record, const RecordContext&) {
    if (const auto* moved = std::get_if<Moved>(&record)) {
        legs_.push_back({moved->node.value, moved->leg});
    } else if (const auto* switched = std::get_if<Switched>(&record)) {
        const bool leaves = !switched->on && leaves_ && leaves_(switched->node, switched->time);
        const std::uint8_t what = leaves ? left : switched->on ? 1 : 0;
        states_.push_back({whole_ns(switched->time), switched->node.value, what});
    } else if (const auto* arrived = std::get_if<Arrived>(&record)) {
        states_.push_back({whole_ns(arrived->time), arrived->node.value, 2});
    } else if (const auto* no_way = std::get_if<NoWay>(&record)) {
        states_.push_back({whole_ns(no_way->time), no_way->node.value, 3});
    } else if (const auto* up = std::get_if<LinkUp>(&record)) {
        links_.push_back({whole_ns(up->time), up->from.value, up->to.value, true});
    } else if (const auto* down = std::get_if<LinkDown>(&record)) {
        links_.push_back({whole_ns(down->time), down->from.value, down->to.value, false});
    }
}

MotionColumns::Bounds MotionColumns::bounds() const {
    if (legs_.empty()) return {};
    const Vec3 p = legs_.front().leg.from;
    Bounds all{p.x, p.y, p.x, p.y};
    for (const RobotLeg& each : legs_) {
        for (const Vec3 end : {each.leg.from, each.leg.to}) {
            all = {std::min(all.left, end.x), std::min(all.bottom, end.y),
                   std::max(all.right, end.x), std::max(all.top, end.y)};
        }
    }
    return all;
}

std::vector<NodeId> MotionColumns::without_leg(std::size_t robots) const {
    std::vector<bool> has_leg(robots);
    for (const RobotLeg& each : legs_)
        if (each.robot < robots) has_leg[each.robot] = true;
    std::vector<NodeId> missing;
    for (NodeId robot{0}; robot.index() < robots; ++robot.value)
        if (!has_leg[robot.index()]) missing.push_back(robot);
    return missing;
}

void MotionColumns::write(ViewFile& file, std::size_t robots) {
    write_legs(file, robots);
    write_states(file, robots);
    write_links(file, robots);
}

void MotionColumns::forget() {
    legs_.clear();
    states_.clear();
    links_.clear();
}

void MotionColumns::write_legs(ViewFile& file, std::size_t robots) {
    std::stable_sort(legs_.begin(), legs_.end(),
                     [](const RobotLeg& a, const RobotLeg& b) { return a.robot < b.robot; });
    // Of legs with the same start, the last one counts.
    const auto kept = std::unique(legs_.rbegin(), legs_.rend(), [](const auto& a, const auto& b) {
        return a.robot == b.robot && a.leg.start == b.leg.start;
    });
    legs_.erase(legs_.begin(), kept.base());
    std::vector<std::uint32_t> first(robots + 1);
    for (const RobotLeg& each : legs_) ++first[each.robot + 1];
    for (std::size_t i = 1; i <= robots; ++i) first[i] += first[i - 1];
    file.add("legs.first", first);
    const auto add = [&](const char* name, auto number, auto get) {
        file.add(name, column<decltype(number)>(legs_, [&](const auto& x) { return get(x.leg); }));
    };
    add("legs.start", 0.0, [](const Leg& leg) { return column_ns(leg.start); });
    add("legs.end", 0.0, [](const Leg& leg) { return column_ns(leg.end); });
    add("legs.x", 0.0, [](const Leg& leg) { return leg.from.x; });
    add("legs.y", 0.0, [](const Leg& leg) { return leg.from.y; });
    add("legs.vx", 0.0, [](const Leg& leg) { return leg.velocity.x; });
    add("legs.vy", 0.0, [](const Leg& leg) { return leg.velocity.y; });
    add("legs.heading", 0.0F, [](const Leg& leg) { return leg.heading; });
    add("legs.turning", 0.0F, [](const Leg& leg) { return leg.turning; });
    const bool is_flat = std::all_of(legs_.begin(), legs_.end(), [](const RobotLeg& each) {
        return each.leg.from.z == 0 && each.leg.to.z == 0;
    });
    if (is_flat) return;
    add("legs.z", 0.0, [](const Leg& leg) { return leg.from.z; });
    add("legs.vz", 0.0, [](const Leg& leg) { return leg.velocity.z; });
}

void MotionColumns::write_states(ViewFile& file, std::size_t robots) const {
    file.add_times("states.time",
                   column<std::int64_t>(states_, [](const State& s) { return s.time; }));
    file.add_indices("states.robot",
                     column<std::uint32_t>(states_, [](const State& s) { return s.robot; }),
                     robots);
    file.add("states.what", column<std::uint8_t>(states_, [](const State& s) { return s.what; }));
}

void MotionColumns::write_links(ViewFile& file, std::size_t robots) const {
    if (links_.empty()) return;
    using Change = LinkChange;
    file.add_times("links.time",
                   column<std::int64_t>(links_, [](const Change& c) { return c.time; }));
    file.add_indices("links.from",
                     column<std::uint32_t>(links_, [](const Change& c) { return c.from; }), robots);
    file.add_indices("links.to",
                     column<std::uint32_t>(links_, [](const Change& c) { return c.to; }), robots);
    file.add("links.up", column<std::uint8_t>(links_, [](const Change& c) { return c.up; }));
}

}  // namespace rovernet
