// SPDX-License-Identifier: MIT
#include "live/player/listeners.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

namespace rovernet {
namespace {

FrontListeners listeners_of(std::vector<FrontListeners::Entry> entries, PlayerSettings settings) {
    return {.entries = std::move(entries),
            .make =
                [settings = std::move(settings)](Front::Carrier carrier) {
                    return std::make_unique<PlayerFront>(settings, std::move(carrier));
                },
            .closing_message = player_overflow};
}

/// Index of the opaque of its comdriver.
std::optional<std::uint32_t> radio_of(const PlayerConfig::Robot& robot) {
    return robot.comdriver ? std::optional(robot.comdriver->index) : std::nullopt;
}

}  // namespace

FrontListeners player_ports(const Address& first, const std::vector<std::string>& robots,
                            PlayerSettings settings) {
    const std::size_t ports = first.port == 0 ? most_player_ports : 65'536U - first.port;
    if (robots.size() > std::min(ports, most_player_ports)) {
        throw std::invalid_argument(
            fmt::format("found {} robots, each of which needs its own port, from port {} on; "
                        "expected {} robots at most, or --player-one-port",
                        robots.size(), first.port, std::min(ports, most_player_ports)));
    }
    std::vector<FrontListeners::Entry> entries;
    for (std::size_t i = 0; i < robots.size(); ++i) {
        Address own = first;
        if (own.port != 0) own.port = static_cast<std::uint16_t>(own.port + i);
        entries.push_back({own, "Player, robot " + robots[i]});
        settings.places.push_back({.robot = robots[i], .listener = i, .index = 0});
    }
    return listeners_of(std::move(entries), std::move(settings));
}

FrontListeners player_configured(const Address& at, const PlayerConfig& config,
                                 const std::vector<std::string>& robots, PlayerSettings settings) {
    std::vector<FrontListeners::Entry> entries;
    std::map<std::uint16_t, std::size_t> listeners;
    for (const PlayerConfig::Robot& each : config.robots) {
        if (std::find(robots.begin(), robots.end(), each.model) == robots.end()) {
            throw InputError(
                each.where, fmt::format("model: {} has no robot \"{}\"", config.world, each.model));
        }
        const auto [listener, is_new] = listeners.try_emplace(each.port, entries.size());
        if (is_new) {
            const std::uint16_t port = at.port == 0 ? std::uint16_t{0} : each.port;
            entries.push_back({{at.host, port}, "Player, robot " + each.model});
        } else {
            entries[listener->second].what += ", " + each.model;
        }
        settings.places.push_back({.robot = each.model,
                                   .listener = listener->second,
                                   .index = each.index,
                                   .relay = each.relay,
                                   .radio = radio_of(each),
                                   .has_ttl = each.comdriver.has_value()});
    }
    return listeners_of(std::move(entries), std::move(settings));
}

FrontListeners player_one_port(const Address& at, const std::vector<std::string>& robots,
                               PlayerSettings settings) {
    for (const std::string& robot : robots) {
        const auto index = static_cast<std::uint32_t>(settings.places.size());
        settings.places.push_back({.robot = robot, .listener = 0, .index = index});
    }
    return listeners_of({{at, "Player, all robots"}}, std::move(settings));
}

}  // namespace rovernet
