// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"

#include <cstdint>

// Memory of large scenarios: a count with a zero too many is told before the machine swaps.

namespace rovernet {

/// Memory that this process may have [bytes]: the machine's, or what a limit leaves (ulimit -v).
std::uint64_t available_memory();

/// Estimate of the memory that a run of the scenario takes for its robots alone [bytes]: 280 for
/// one that stands, 1000 for one that moves. Both were measured; maps, traces and messages come on
/// top.
std::uint64_t robots_memory(const Scenario& scenario);

/// Checks the robots' memory before anything is made of them. More than is available is refused;
/// more than 1 GB gives a notice. Robots that only a movement file names are no reason.
/// @param available  memory that the process may have [bytes]
/// @throws InputError at the [[robot]] that takes most of it
void check_memory(Scenario& scenario, std::uint64_t available);

}  // namespace rovernet
