// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// Flows of an ns-2 traffic file, and notices about them.
struct TrafficFile {
    /// Unicast flows between robots n0, n1, ..., in the order in which the file creates their
    /// applications; without names.
    std::vector<TrafficTable> flows;
    /// Notices to the user about flows whose intervals are random in ns-2 but constant here.
    std::vector<std::string> notices;
};

/// Reads an ns-2 traffic file, as cbrgen.tcl writes it: constant bit rate over UDP.
///
/// A flow is a CBR application on a UDP agent on a node, connected to an agent on another node:
///
///   set udp_(0) [new Agent/UDP]
///   $ns_ attach-agent $node_(1) $udp_(0)
///   set null_(0) [new Agent/Null]
///   $ns_ attach-agent $node_(2) $null_(0)
///   set cbr_(0) [new Application/Traffic/CBR]
///   $cbr_(0) set packetSize_ 512
///   $cbr_(0) attach-agent $udp_(0)
///   $ns_ connect $udp_(0) $null_(0)
///   $ns_ at 2.5 "$cbr_(0) start"
///
/// packetSize_ (default 210 B), interval_ or rate_ (448 kb/s) and maxpkts_ are read; the defaults
/// are those of ns-2.35. Flows that are never started are omitted. The first packet is sent at the
/// start time. No packet is sent at or after the stop time.
/// @throws InputError with file, line and column for any other statement, such as TCP
TrafficFile read_traffic_file(const std::string& path);

/// Adds the flows of an ns-2 traffic file to the scenario `out`. `value` is the table [traffic]
/// with the key `file`, such as file = "cbr.tcl". The path is relative to the scenario file.
/// @throws InputError as read_traffic_file(), or at the key if the file cannot be read
void read_flows(const Value& value, Scenario& out);

}  // namespace rovernet
