// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/address.hpp"
#include "live/paced_run.hpp"
#include "live/player/config.hpp"
#include "live/player/front.hpp"
#include "scenario/names.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Default address at which Player clients connect.
inline constexpr std::string_view player_address = "127.0.0.1:6665";
/// Largest number of robots whose Player devices have a port for each robot.
inline constexpr std::size_t most_player_ports = 100;

/// Player server with a port for each robot: the first robot has the port of `first`, the next
/// robot the next port, and so on. With port 0 each robot has any free port.
/// @param settings  settings of the server, without places of robots
/// @throws std::invalid_argument if there are more robots than ports
FrontListeners player_ports(const Address& first, const std::vector<std::string>& robots,
                            PlayerSettings settings);
/// Player server with all robots at one port: the first robot's devices have index 0, and so on.
FrontListeners player_one_port(const Address& at, const std::vector<std::string>& robots,
                               PlayerSettings settings);

/// Player server with the ports of a configuration file; with port 0 in `at`, all ports are any
/// free ones.
/// @throws InputError for a robot that is not in the scenario
FrontListeners player_configured(const Address& at, const PlayerConfig& config,
                                 const std::vector<std::string>& robots, PlayerSettings settings);

}  // namespace rovernet
