// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/address.hpp"
#include "live/paced_run.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace rovernet {

/// Where the relay's first port is.
inline constexpr std::string_view relay_address = "127.0.0.1:7100";

/// Door for programs that send datagrams (RelayFormat): the first robot's port is at `first`, the
/// next one's at the next. With port 0 each has any that is free.
FrontDoor udp_relay(const Address& first);
/// Checks that there are ports for so many robots, before anything is made.
/// @throws std::invalid_argument
void check_udp_ports(const Address& first, std::size_t robots);

/// Door for programs that use the network as ever: each robot has a network namespace, and in it a
/// TAP device with its addresses (EthernetFormat, Namespaces).
/// @param folder  of the run's results, by which programs find it
/// @param go_on   asked while the devices are made; false ends that
FrontDoor tap_devices(const std::string& folder, std::function<bool()> go_on);

}  // namespace rovernet
