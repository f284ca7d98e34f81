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

/// Copy of the scenario without traffic that cannot affect movements and links. If no robot has
/// reactions, the copy has no traffic; otherwise it has all traffic.
Scenario without_idle_traffic(const Scenario& scenario);

/// Network of the scenario after a run until the time `at` with all traffic of the scenario, so
/// that routing tables have their states at that time, too.
std::unique_ptr<Network> network_with_traffic_at(const Scenario& scenario, Time at,
                                                 const TellTime& tell = {});

/// Network of the scenario after a run until the time `at` with without_idle_traffic(). Robots and
/// links have their states at that time.
std::unique_ptr<Network> network_at(const Scenario& scenario, Time at, const TellTime& tell = {});

}  // namespace rovernet
