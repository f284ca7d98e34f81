// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "scenario/scenario.hpp"

namespace rovernet {

/// Warm-up [ns] of a scenario's run, by [study] warmup: metrics start after it. With "mser5", a
/// first run is made, and mser5() is applied to the series of the messages' delivery ratios.
/// @param settings  from network_settings(scenario); their planners are shared by all runs
Duration warmup_of(const Scenario& scenario, NetworkSettings settings);

}  // namespace rovernet
