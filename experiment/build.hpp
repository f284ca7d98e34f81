// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "scenario/scenario.hpp"
#include "sim/router.hpp"

namespace rovernet {

/// Settings of a Network for a scenario. Loads the scenario's map unless it is already loaded.
/// @throws InputError at the line of the scenario, followed by the error of the map
NetworkSettings network_settings(const Scenario& scenario);

/// Puts the scenario's robots, protocol, reactions and traffic into a Network made with
/// network_settings(scenario).
/// @throws InputError for errors that need the map: a robot in a wall, a goal that no path reaches
void populate(Network& network, const Scenario& scenario);
/// Puts a scenario into a Network made with network_settings(scenario), with the routing protocol
/// `router` instead of the scenario's protocol.
void populate(Network& network, const Scenario& scenario, Router router);

}  // namespace rovernet
