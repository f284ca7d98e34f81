// SPDX-License-Identifier: MIT
#include "traces/topology.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <variant>

namespace rovernet {

Topology::Robot& Topology::robot(NodeId node) {
    if (node.index() >= robots_.size()) robots_.resize(node.index() + 1);
    Robot& robot = robots_[node.index()];
    if (!std::exchange(robot.is_there, true)) {
        ++there_;
        on_ += robot.on;
    }
    return robot;
}

void Topology::on(const Record& record, const RecordContext&) {
    if (const auto* moved = std::get_if<Moved>(&record)) {
        advance(moved->time);
        Robot& one = robot(moved->node);
        end_leg(one, moved->time);
        one.speed = std::sqrt(dot(moved->leg.velocity, moved->leg.velocity));
        one.until = moved->leg.end;
    } else if (const auto* switched = std::get_if<Switched>(&record)) {
        advance(switched->time);
        Robot& one = robot(switched->node);
        on_ = on_ + static_cast<std::size_t>(switched->on) - static_cast<std::size_t>(one.on);
        one.on = switched->on;
    } else if (const auto* up = std::get_if<LinkUp>(&record)) {
        advance(up->time);
        up_.emplace(std::pair{up->from, up->to}, up->time);
    } else if (const auto* down = std::get_if<LinkDown>(&record)) {
        advance(down->time);
        const auto found = up_.find({down->from, down->to});
        if (found == up_.end()) return;
        // The start of a link that existed from the beginning is unknown.
        if (found->second > begin_) {
            lifetime_ += seconds(down->time - found->second);
            ++ended_;
        }
        up_.erase(found);
    }
}

/// Adds the time since the previous record to the sums.
void Topology::advance(Time t) {
    for (; next_sample_ < t; next_sample_ += std::chrono::seconds{1}) sample();
    if (t <= now_) return;
    const double passed = seconds(t - now_);
    link_s_ += passed * static_cast<double>(up_.size());
    on_s_ += passed * static_cast<double>(on_);
    robot_s_ += passed * static_cast<double>(there_);
    now_ = t;
}

/// Counts the connected components: robots that are on, minus one for every link that joins two
/// components.
void Topology::sample() {
    std::vector<std::uint32_t> part(robots_.size());
    std::iota(part.begin(), part.end(), 0U);
    const auto root = [&](std::uint32_t i) {
        while (part[i] != i) i = part[i] = part[part[i]];
        return i;
    };
    ++samples_;
    components_ += on_;
    for (const auto& [ends, since] : up_) {
        const std::uint32_t a = root(ends.first.value), b = root(ends.second.value);
        if (a == b) continue;
        part[a] = b;
        --components_;
    }
}

/// Adds the robot's path on its leg until `t`, within the measured time.
void Topology::end_leg(Robot& robot, Time t) {
    const Time from = std::max(robot.since, begin_), until = std::min(robot.until, t);
    if (until > from) way_ += robot.speed * seconds(until - from);
    robot.since = t;
}

TopologyValues Topology::values(Time end) {
    advance(end);
    if (next_sample_ == end) sample();
    for (Robot& each : robots_) end_leg(each, end);
    const auto mean = [](double sum, double over) {
        return over > 0 ? std::optional(sum / over) : std::nullopt;
    };
    return {
        .degree_mean = mean(link_s_, on_s_),
        .components_mean = mean(static_cast<double>(components_), static_cast<double>(samples_)),
        .speed_mean = mean(way_, robot_s_),
        .link_lifetime_mean = mean(lifetime_, static_cast<double>(ended_)),
        .links_ended = ended_};
}

}  // namespace rovernet
