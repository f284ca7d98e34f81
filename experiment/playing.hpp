// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "sim/time.hpp"

#include <functional>

namespace rovernet {

/// Told the simulated time that has been reached, now and then while a network is played.
using TellTime = std::function<void(Time)>;

/// Runs the network until `end` and tells how far it is; empty: nobody wants to know.
void play_until(Network& network, Time end, const TellTime& tell);

}  // namespace rovernet
