// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "sim/time.hpp"

#include <functional>

namespace rovernet {

/// Function that is told the simulated time reached, now and then, while a network runs.
using TellTime = std::function<void(Time)>;

/// Runs the network until `end` and tells how far it is. @param tell  may be empty
void play_until(Network& network, Time end, const TellTime& tell);

}  // namespace rovernet
