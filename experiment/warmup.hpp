// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "scenario/scenario.hpp"

namespace rovernet {

/// Time after the start of a scenario's run at which its metrics begin, as [study] warmup says.
/// With "mser5" it makes a first run and applies mser5() to the series of each message's delivery
/// ratio.
/// @param settings  network_settings(scenario), with planners kept from run to run
Duration warmup_of(const Scenario& scenario, NetworkSettings settings);

}  // namespace rovernet
