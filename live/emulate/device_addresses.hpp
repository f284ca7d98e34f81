// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// Checks the addresses that the robots' network devices get, given or made, before anything is
/// built: a label is enough for a table, but not for the kernel.
///
/// A mac is that of a single device (IEEE 802-2014, 8.2), an ip that of a single host (RFC 1122,
/// 3.2.1.3), a netmask has its ones first (RFC 950), and an ip is neither the address of its
/// network nor its broadcast address (networks of 31 bits have neither: RFC 3021). No two robots
/// have the same. Robots that are outside of each other's network are told, as programs reach them
/// by routes of their own only; and addresses that were made and cannot be used.
/// @return notices
/// @throws InputError at the first that the file gives wrongly
std::vector<std::string> check_device_addresses(const Scenario& scenario);

}  // namespace rovernet
