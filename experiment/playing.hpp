// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "sim/time.hpp"

#include <functional>

namespace rovernet {

/// Callback that gets the current simulated time; called repeatedly while a network runs.
using TellTime = std::function<void(Time)>;

/// Runs the network until the time `end`. @param tell  called repeatedly with the simulated time;
/// may be empty
void play_until(Network& network, Time end, const TellTime& tell);

}  // namespace rovernet
