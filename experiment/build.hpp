// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "scenario/scenario.hpp"

namespace rovernet {

/// Settings of a Network for this scenario; loads its map.
/// @throws InputError naming the scenario's line, then the map's own error
NetworkSettings network_settings(const Scenario& scenario);

/// Puts the scenario's robots, protocol, reactions and traffic into a Network made with
/// network_settings(scenario).
/// @throws InputError for what only shows on the map: a robot in a wall, a goal without a way
void populate(Network& network, const Scenario& scenario);

}  // namespace rovernet
