// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/playing.hpp"
#include "sim/time.hpp"

#include <memory>

namespace rovernet {

class Network;
struct Scenario;

/// Whether some robot of the scenario reacts to messages or arrivals.
bool somebody_reacts(const Scenario& scenario);

/// Copy of the scenario without traffic that cannot affect robots and links: without any traffic,
/// unless a robot reacts to messages.
Scenario without_idle_traffic(const Scenario& scenario);

/// Network with robots and links in the state of the scenario's run at time `at`.
std::unique_ptr<Network> network_at(const Scenario& scenario, Time at, const TellTime& tell = {});

}  // namespace rovernet
