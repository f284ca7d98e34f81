// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// The flows of an ns-2 traffic file, and what a person should know of them.
struct TrafficFile {
    std::vector<TrafficTable> flows;  ///< unicasts from n0, n1, ... in the order of the file
    std::vector<std::string> notices;
};

/// Reads an ns-2 traffic file, as cbrgen.tcl writes it: constant bit rate over UDP.
///
/// A flow is a CBR application on a UDP agent on a node, connected to an agent on another node. Its
/// packetSize_ (210 B), interval_ or rate_ (448 kb/s) and maxpkts_ count; defaults are those of
/// ns-2.35. Flows that nothing starts are left out. The first packet goes out at the start, none at
/// or after the stop.
/// @throws InputError with file, line and column for what is none of that, such as TCP
TrafficFile read_traffic_file(const std::string& path);

/// Adds the flows of the file that `value`, a table with the key `file`, names.
/// @throws InputError
void read_flows(const Value& value, Scenario& out);

}  // namespace rovernet
