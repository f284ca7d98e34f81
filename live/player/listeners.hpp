// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/address.hpp"
#include "live/paced_run.hpp"
#include "live/player/config.hpp"
#include "live/player/front.hpp"
#include "scenario/scenario.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Where Player looks for a server.
inline constexpr std::string_view player_address = "127.0.0.1:6665";
/// Robots that have ports of their own, at most.
inline constexpr std::size_t most_player_ports = 100;

/// Names of a scenario's robots in their order, those of its movement file last.
std::vector<std::string> robot_names(const Scenario& scenario);

/// Player server with a port for each robot: the first robot's at `first`, and so on. With port 0
/// each gets any that is free.
/// @param settings  without places
/// @throws std::invalid_argument for more robots than there are ports
FrontDoor player_ports(const Address& first, const std::vector<std::string>& robots,
                       PlayerSettings settings);
/// Player server with all robots at one port: the first robot's devices have index 0, and so on.
FrontDoor player_one_port(const Address& at, const std::vector<std::string>& robots,
                          PlayerSettings settings);

/// Player server with the ports of a configuration; with port 0 in `at` each is any that is free.
/// @throws InputError for a robot that the scenario does not have
FrontDoor player_configured(const Address& at, const PlayerConfig& config,
                            const std::vector<std::string>& robots, PlayerSettings settings);

}  // namespace rovernet
