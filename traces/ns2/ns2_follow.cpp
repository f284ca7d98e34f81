// SPDX-License-Identifier: MIT
#include "traces/ns2/ns2_follow.hpp"

#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rovernet {
namespace {

std::optional<NodeId> from(const Ns2Packet& p) {
    if (!p.mac || !p.mac->has_sent() || p.mac->from >= most_robots) return std::nullopt;
    return NodeId{p.mac->from};
}

}  // namespace

bool Ns2Follower::carries(const Ns2Packet& p) const {
    return is_found_ && p.uid == way_.uid && p.type == way_.type && p.ip &&
           p.ip->from_port != routing_port;
}

void Ns2Follower::begin(const Ns2Packet& p) {
    is_found_ = true;
    way_.type = p.type;
    way_.origin = p.node;
    if (p.ip->to >= 0) way_.to = static_cast<std::uint32_t>(p.ip->to);
    way_.sent = p.time;
    way_.size = p.size.value_or(0);
    way_.ttl = p.ip->ttl;
    FollowedRobot origin;
    origin.robot = p.node;
    origin.time = p.time;
    by_robot_.emplace(p.node.value, origin);
    order_.push_back(p.node.value);
}

void Ns2Follower::received(const Ns2Packet& p) {
    const bool is_own_on_its_way_down = p.layer == "RTR" && !from(p);
    if (is_own_on_its_way_down) return;
    const auto [entry, is_new] = by_robot_.try_emplace(p.node.value);
    FollowedRobot& robot = entry->second;
    if (is_new) {
        robot.robot = p.node;
        robot.time = p.time;
        robot.from = from(p);
        const auto parent = by_robot_.find(robot.from.value_or(way_.origin).value);
        robot.depth = parent == by_robot_.end() ? 1 : parent->second.depth + 1;
        if (p.node != way_.origin)
            robot.hops = std::max<std::int64_t>(first_ttl_.value_or(way_.ttl) - p.ip->ttl + 1, 1);
        order_.push_back(p.node.value);
    }
    const bool is_same_copy = p.layer == "AGT" && robot.copies > 0;
    if (!is_same_copy && p.node != way_.origin) ++robot.copies;
    if (p.layer == "AGT" && p.node != way_.origin) robot.is_delivered = true;
}

void Ns2Follower::on(const Ns2Packet& p) {
    robots_.insert(p.node.value);
    const bool begins = p.op == 's' && p.layer == "AGT" && p.type != "ack" && p.ip &&
                        p.ip->from_port != routing_port;
    if (begins && !is_found_) {
        if (p.uid == way_.uid) return begin(p);
        least_ = std::min(least_.value_or(p.uid), p.uid);
        most_ = std::max(most_, p.uid);
    }
    if (!carries(p)) return;
    if (p.op == 'D') {
        std::optional<NodeId> sender = from(p);
        if (sender == p.node) sender.reset();  // the copy that the robot could not send on
        way_.lost.push_back({p.time, p.node, sender, std::string(p.layer), std::string(p.reason)});
    } else if (p.op == 'r' && (p.layer == "RTR" || p.layer == "AGT")) {
        received(p);
    } else if (p.layer == "RTR" && by_robot_.contains(p.node.value)) {
        if (!first_ttl_) first_ttl_ = p.ip->ttl;
        by_robot_[p.node.value].on_air.push_back(p.time);
    }
}

FollowedMessage Ns2Follower::way(const std::string& trace) const {
    if (!is_found_) {
        std::string known = "this trace has no messages";
        if (least_) {
            known = fmt::format("expected the id of a message, from {} to {}", *least_, most_);
            const bool is_between = way_.uid >= *least_ && way_.uid <= most_;
            if (is_between) known += "; control packets have ids in this range, too";
        }
        throw InputError({.source = trace},
                         fmt::format("found no message with the id {}; {}", way_.uid, known));
    }
    FollowedMessage way = way_;
    std::map<std::uint32_t, std::vector<std::uint32_t>> children;
    std::set<std::uint32_t> earlier;
    for (const std::uint32_t robot : order_) {
        const std::uint32_t parent = by_robot_.at(robot).from.value_or(way_.origin).value;
        const bool is_known = earlier.contains(parent);
        if (!earlier.empty()) children[is_known ? parent : way_.origin.value].push_back(robot);
        earlier.insert(robot);
    }
    std::vector<std::uint32_t> next{way_.origin.value};
    while (!next.empty()) {
        const std::uint32_t robot = next.back();
        next.pop_back();
        way.robots.push_back(by_robot_.at(robot));
        const auto& below = children[robot];
        next.insert(next.end(), below.rbegin(), below.rend());
    }
    for (const std::uint32_t robot : robots_) {
        if (!by_robot_.contains(robot)) way.without.push_back({robot});
    }
    return way;
}

FollowedMessage follow_ns2(Ns2Source source, std::uint64_t uid, Ns2Strictness strictness) {
    Ns2File file(std::move(source), strictness);
    Ns2Follower follower(uid);
    while (const Ns2Line* line = file.next()) follower.take(*line);
    file.expect_trace();
    FollowedMessage way = follower.way(file.name());
    way.counts = file.counts();
    return way;
}

}  // namespace rovernet
