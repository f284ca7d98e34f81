// SPDX-License-Identifier: MIT
#include "live/player/listeners.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <utility>

namespace rovernet {
namespace {

FrontDoor door(std::vector<FrontDoor::Entry> entries, PlayerSettings settings) {
    return {.entries = std::move(entries),
            .make =
                [settings = std::move(settings)](Front::Carrier carrier) {
                    return std::make_unique<PlayerFront>(settings, std::move(carrier));
                },
            .farewell = player_overflow};
}

}  // namespace

std::vector<std::string> robot_names(const Scenario& scenario) {
    std::vector<std::string> names;
    for (const RobotTable& table : scenario.robots) {
        for (int i = 0; i < table.count.value_or(1); ++i) names.push_back(table.name_of(i));
    }
    const std::set<std::string> in_tables(names.begin(), names.end());
    for (const FileRobot& robot : scenario.movement.robots) {
        if (!in_tables.contains(robot.name)) names.push_back(robot.name);
    }
    return names;
}

FrontDoor player_ports(const Address& first, const std::vector<std::string>& robots,
                       PlayerSettings settings) {
    const std::size_t ports = first.port == 0 ? most_player_ports : 65'536U - first.port;
    if (robots.size() > std::min(ports, most_player_ports)) {
        throw std::invalid_argument(
            fmt::format("found {} robots, each with a port of its own from {} on; expected {} at "
                        "most, or --player-one-port",
                        robots.size(), first.port, std::min(ports, most_player_ports)));
    }
    std::vector<FrontDoor::Entry> entries;
    for (std::size_t i = 0; i < robots.size(); ++i) {
        Address own = first;
        if (own.port != 0) own.port = static_cast<std::uint16_t>(own.port + i);
        entries.push_back({own, "Player, robot " + robots[i]});
        settings.places.push_back({.robot = robots[i], .entrance = i, .index = 0});
    }
    return door(std::move(entries), std::move(settings));
}

FrontDoor player_configured(const Address& at, const PlayerConfig& config,
                            const std::vector<std::string>& robots, PlayerSettings settings) {
    std::vector<FrontDoor::Entry> entries;
    std::map<std::uint16_t, std::size_t> entrances;
    for (const PlayerConfig::Robot& each : config.robots) {
        if (std::find(robots.begin(), robots.end(), each.model) == robots.end()) {
            throw InputError(each.where, fmt::format("model: {} has no robot \"{}\" with a radio",
                                                     config.world, each.model));
        }
        const auto [entrance, is_new] = entrances.try_emplace(each.port, entries.size());
        if (is_new) {
            const std::uint16_t port = at.port == 0 ? std::uint16_t{0} : each.port;
            entries.push_back({{at.host, port}, "Player, robot " + each.model});
        } else {
            entries[entrance->second].what += ", " + each.model;
        }
        settings.places.push_back({each.model, entrance->second, each.index});
    }
    return door(std::move(entries), std::move(settings));
}

FrontDoor player_one_port(const Address& at, const std::vector<std::string>& robots,
                          PlayerSettings settings) {
    for (const std::string& robot : robots) {
        const auto index = static_cast<std::uint32_t>(settings.places.size());
        settings.places.push_back({.robot = robot, .entrance = 0, .index = index});
    }
    return door({{at, "Player, all robots"}}, std::move(settings));
}

}  // namespace rovernet
