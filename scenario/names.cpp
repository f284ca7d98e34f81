// SPDX-License-Identifier: MIT
#include "scenario/names.hpp"

#include <fmt/format.h>

#include <map>
#include <set>

namespace rovernet {
namespace {

class Names {
  public:
    explicit Names(const Scenario& scenario) : scenario_(scenario) {
        for (const RobotTable& robot : scenario.robots) {
            for (int i = 0; i < robot.count.value_or(1); ++i) add(robot.name_of(i), robot);
        }
        for (const FileRobot& robot : scenario.movement.robots) names_.emplace(robot.name, nullptr);
    }

    /// Checks that there is a robot of that name.
    /// @param key  key that names it, at `where`
    void check(const std::string& name, std::string_view key, const Location& where) const {
        if (names_.contains(name)) return;
        const std::string near = suggestion(name);
        throw InputError(where, fmt::format("{}: there is no robot \"{}\"; expected the name of a "
                                            "[[robot]]{}{}",
                                            key, name, near.empty() ? "" : "; ", near));
    }
    void check(const MoveTable& move) const {
        if (!move.leader.empty()) check(move.leader, "leader", move.leader_where);
    }

  private:
    void add(const std::string& name, const RobotTable& robot) {
        const auto [first, added] = names_.emplace(name, &robot);
        if (added) return;
        throw InputError(robot.where,
                         fmt::format("two robots are named \"{}\"; the first of them is defined at "
                                     "{}; give each robot a different name",
                                     name, first->second->where.text()));
    }
    std::string suggestion(const std::string& name) const {
        for (const RobotTable& robot : scenario_.robots) {
            if (robot.count && robot.name == name) {
                return fmt::format(
                    "the [[robot]] of this name has the key \"count\", so its robots are named {}0 "
                    "to {}{}",
                    name, name, *robot.count - 1);
            }
        }
        constexpr std::size_t most_compared = 1000;
        std::vector<std::string> candidates;
        for (const auto& [known, robot] : names_) {
            if (candidates.size() < most_compared) candidates.push_back(known);
        }
        return did_you_mean(name, candidates);
    }

    const Scenario& scenario_;
    std::map<std::string, const RobotTable*, std::less<>> names_;
};

/// Addresses by the robot to which each was given first.
using Given = std::map<std::string, const RobotTable*, std::less<>>;

void check_address(Given& given, const std::optional<std::string>& address, std::string_view what,
                   const RobotTable& robot) {
    if (!address) return;
    const auto [first, added] = given.emplace(*address, &robot);
    if (added && robot.count.value_or(1) == 1) return;
    const RobotTable& other = *first->second;
    const std::string both = &other == &robot
                                 ? fmt::format("all robots \"{}\" have", robot.name)
                                 : fmt::format("robots \"{}\" ({}) and \"{}\" have", other.name,
                                               other.where.text(), robot.name);
    const std::string message = fmt::format("{} the same {}, {}", both, what, *address);
    throw InputError(
        robot.radio_where,
        message +
            "; give each robot its own address, or leave the key out to get a generated address");
}

}  // namespace

void check_names(const Scenario& scenario) {
    const Names names(scenario);
    for (const RobotTable& robot : scenario.robots) {
        names.check(robot.move);
        for (const ReactionTable& reaction : robot.reactions) {
            if (reaction.from) names.check(*reaction.from, "from", reaction.from_where);
            if (reaction.to && *reaction.to != ReactionTable::sender) {
                names.check(*reaction.to, "to", reaction.to_where);
            }
            if (reaction.move) names.check(*reaction.move);
        }
    }
    for (const TrafficTable& traffic : scenario.traffic) {
        if (traffic.from != "random" || !traffic.start) {
            names.check(traffic.from, "from", traffic.from_where);
        }
        if (traffic.to) names.check(*traffic.to, "to", traffic.to_where);
    }
}

std::vector<std::string> robot_names(const Scenario& scenario) {
    std::vector<std::string> names;
    for (const RobotTable& robot : scenario.robots) {
        for (int i = 0; i < robot.count.value_or(1); ++i) names.push_back(robot.name_of(i));
    }
    const std::set<std::string, std::less<>> listed(names.begin(), names.end());
    for (const FileRobot& robot : scenario.movement.robots) {
        if (!listed.contains(robot.name)) names.emplace_back(robot.name);
    }
    return names;
}

void check_addresses(const Scenario& scenario) {
    if (scenario.scene.world) return;
    Given ips, macs;
    for (const RobotTable& robot : scenario.robots) {
        check_address(ips, robot.radio.labels.ip, "ip", robot);
        check_address(macs, robot.radio.labels.mac, "mac", robot);
    }
}

}  // namespace rovernet
