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
/// Largest number of robots of a Player server that has a port for each robot.
inline constexpr std::size_t most_player_ports = 100;

/// Player server with a TCP port for each robot: robot i of `robots` has the port of `first` + i.
/// If the port of `first` is 0, each robot has any free port.
/// @param robots    names of the robots
/// @param settings  settings of the server; its list `places` is filled in
/// @throws std::invalid_argument if there are more robots than ports
FrontListeners player_ports(const Address& first, const std::vector<std::string>& robots,
                            PlayerSettings settings);
/// Player server with all robots at one TCP port: the devices of robot i of `robots` have index i.
FrontListeners player_one_port(const Address& at, const std::vector<std::string>& robots,
                               PlayerSettings settings);

/// Player server with the TCP ports of a configuration file; if the port of `at` is 0, any free
/// ports are used.
/// @throws InputError for a robot that is not in the scenario
FrontListeners player_configured(const Address& at, const PlayerConfig& config,
                                 const std::vector<std::string>& robots, PlayerSettings settings);

}  // namespace rovernet
