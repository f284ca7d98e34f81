// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "scenario/scenario.hpp"

#include <functional>

namespace rovernet {

/// Duration of the warm-up of a scenario's run [ns], by the key warmup of [study]. Metrics exclude
/// the warm-up. With "mser5", a first run is made, and mser5() is applied to the series of delivery
/// ratios of this run's messages.
/// @param settings  made by network_settings(scenario); all runs share the path planners in it
/// @param router    makes the routing protocol in place of the scenario's protocol; may be empty
Duration warmup_of(const Scenario& scenario, NetworkSettings settings,
                   const std::function<Router()>& router = {});

}  // namespace rovernet
