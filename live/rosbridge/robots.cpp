// SPDX-License-Identifier: MIT
#include "live/rosbridge/robots.hpp"

#include "live/carriers/request.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <tuple>
#include <variant>

namespace rovernet {
namespace {

bool is_movement(const RobotCommand& command) {
    return !std::holds_alternative<SendCommand>(command) &&
           !std::holds_alternative<PlaceCommand>(command);
}

}  // namespace

void RosRobots::take(NodeId robot) {
    if (clients_.contains(robot)) return;
    if (session_.driver(robot)) {
        throw RequestError("taken", "",
                           "robot " + session_.network().name(robot) +
                               " is driven by another program, so ROS clients cannot drive it");
    }
    clients_[robot] = session_.attach({robot}, "rosbridge");
}

std::optional<std::uint64_t> RosRobots::carry_out(NodeId robot, const RobotCommand& command,
                                                  Front::Connection by) {
    const std::string why = session_.why_not(robot, command);
    if (!why.empty()) {
        const bool is_topic = std::holds_alternative<GoalCommand>(command);
        throw RequestError("no_room", is_topic ? "msg.pose.position" : "args.pose.position", why);
    }
    take(robot);
    if (is_movement(command)) drivers_[robot] = by;
    return session_.carry_out(clients_.at(robot), robot, command, ++commands_);
}

void RosRobots::left(Front::Connection client) {
    std::vector<NodeId> own;
    for (const auto& [robot, driver] : drivers_) {
        if (driver == client) own.push_back(robot);
    }
    for (const NodeId robot : own) {
        carry_out(robot, StopCommand{}, client);
        drivers_.erase(robot);
    }
}

std::vector<HeardMessage> RosRobots::heard() {
    std::vector<HeardMessage> all;
    for (const auto& [robot, client] : clients_) {
        auto heard = session_.heard(client);
        std::move(heard.begin(), heard.end(), std::back_inserter(all));
    }
    std::stable_sort(all.begin(), all.end(), [](const HeardMessage& a, const HeardMessage& b) {
        return std::tie(a.time, a.at) < std::tie(b.time, b.at);
    });
    for (const HeardMessage& each : all) last_heard_[{each.at, each.last_hop}] = each.time;
    return all;
}

std::optional<Time> RosRobots::last_heard(NodeId at, NodeId last_hop) const {
    const auto found = last_heard_.find({at, last_hop});
    return found == last_heard_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace rovernet
