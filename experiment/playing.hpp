// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "sim/time.hpp"

#include <functional>

namespace rovernet {

/// Callback that gets the simulated time reached, called now and then while a network runs.
using TellTime = std::function<void(Time)>;

/// Runs the network until `end` and reports its progress. @param tell  may be empty
void play_until(Network& network, Time end, const TellTime& tell);

}  // namespace rovernet
