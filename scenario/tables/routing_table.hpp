// SPDX-License-Identifier: MIT
#pragma once

#include "routing/list.hpp"
#include "scenario/tables/model_choice.hpp"
#include "sim/router.hpp"

// Routing protocols in a scenario file:
//
//     [routing]
//     protocol = "flood"
//     ttl = 3

namespace rovernet {

/// [routing]: the chosen routing protocol, by default flood, and the given parameters of all listed
/// protocols. make() returns the protocol for Network::route().
using RoutingTable = ModelChoice<RoutingProtocols, Router>;

}  // namespace rovernet
