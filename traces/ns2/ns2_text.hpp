// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"
#include "traces/ns2/ns2_line.hpp"

#include <string>
#include <string_view>

namespace rovernet {

// Conversion of events to lines of text. Each function appends a line with its end to `out`.
// Functions for packet lines return "", or the reason (static text) for which the line could not be
// written.
//
// A payload can be converted if it is empty, of constant bit rate ("[seq] n n") or of TCP ("[seq
// ack] n n"). ARP packets and control frames of the MAC cannot be converted, since the new format
// has neither their type nor their size.

/// Appends a packet line in the old format of ns-2. @return "" if the line is written; otherwise
/// the reason for which it cannot be written
std::string_view write_old_line(const Ns2Packet& packet, std::string& out);
/// Appends a packet line in the new format of ns-2. @param place  position of the robot [m]
/// @return "" if the line is written; otherwise the reason for which it cannot be written
std::string_view write_new_line(const Ns2Packet& packet, Vec3 place, std::string& out);

/// Column names of the CSV rows of write_csv_line().
extern const std::string_view ns2_csv_head;
/// Appends an event as a row of CSV; fields that the line does not have are empty. Times in
/// seconds, MAC addresses as decimal numbers.
void write_csv_line(const Ns2Line& event, std::string& out);

}  // namespace rovernet
