// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// Checks the addresses, given or generated, of the robots' network devices before the devices are
/// made, because the kernel rejects invalid addresses.
///
/// A mac must be a unicast address (IEEE 802-2014, 8.2), an ip a unicast address (RFC 1122,
/// 3.2.1.3), and a netmask a prefix of ones (RFC 950). An ip must not be the network or broadcast
/// address; a network with a 31-bit prefix has no such addresses (RFC 3021). Addresses must be
/// unique. The notices list generated addresses that are unusable, and robots in different IP
/// networks, which programs reach only by explicit routes.
/// @return notices for the user
/// @throws InputError at the first wrong address in the file
std::vector<std::string> check_device_addresses(const Scenario& scenario);

}  // namespace rovernet
