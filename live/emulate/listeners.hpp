// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/address.hpp"
#include "live/paced_run.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace rovernet {

/// Default address of the UDP port of the first robot.
inline constexpr std::string_view relay_address = "127.0.0.1:7100";

/// UDP listeners for programs that send datagrams (RelayFormat). The first robot has the port of
/// `first`, each further robot the next port number. If the port of `first` is 0, each robot has
/// any free port.
FrontListeners udp_relay(const Address& first);
/// Checks that all robots can have successive port numbers, from the port of `first` on.
/// @throws std::invalid_argument if there are too few port numbers
void check_udp_ports(const Address& first, std::size_t robots);

/// Network devices for unmodified programs: each robot has a network namespace with a TAP device
/// that has the robot's addresses (EthernetFormat, Namespaces).
/// @param folder  folder of the run's results, by which programs find the run
/// @param go_on   called repeatedly during the setup of the devices; returning false stops it
FrontListeners tap_devices(const std::string& folder, std::function<bool()> go_on);

}  // namespace rovernet
