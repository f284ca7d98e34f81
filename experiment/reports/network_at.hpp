// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/playing.hpp"
#include "sim/time.hpp"

#include <memory>

namespace rovernet {

class Network;
struct Scenario;

/// Whether any robot of the scenario has reactions (to messages, arrivals, lost links or times).
bool somebody_reacts(const Scenario& scenario);

/// Copy of the scenario with only the traffic that may affect movements and links: no traffic if no
/// robot has reactions, otherwise all traffic.
Scenario without_idle_traffic(const Scenario& scenario);

/// Network of the scenario after a run until the time `at` with all traffic of the scenario.
/// Robots, links and routing tables have their states at that time.
std::unique_ptr<Network> network_with_traffic_at(const Scenario& scenario, Time at,
                                                 const TellTime& tell = {});

/// Network of the scenario after a run until the time `at` with without_idle_traffic(). Robots and
/// links have their states at that time.
std::unique_ptr<Network> network_at(const Scenario& scenario, Time at, const TellTime& tell = {});

}  // namespace rovernet
