// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"
#include "traces/ns2/ns2_line.hpp"

#include <string>
#include <string_view>

namespace rovernet {

// Events as lines of text. Each function adds a line with its end to `out`; packet lines of ns-2
// may say why they cannot: the reason, which lives for ever, or "" if the line is there.
//
// A payload is converted if it is empty, that of constant bit rate ("[seq] n n") or that of TCP
// ("[seq ack] n n"). ARP and frames of the MAC's own are not: the new format has neither their type
// nor their size.

/// Adds the packet as ns-2 writes it in the old format.
std::string_view write_old_line(const Ns2Packet& packet, std::string& out);
/// Adds the packet in the new format. @param place  where the robot is then [m]
std::string_view write_new_line(const Ns2Packet& packet, Vec3 place, std::string& out);

/// Column names of write_csv_line().
extern const std::string_view ns2_csv_head;
/// Adds an event as a row: what the line does not tell is empty. Times in seconds, addresses of the
/// MAC as decimal numbers.
void write_csv_line(const Ns2Line& event, std::string& out);

}  // namespace rovernet
