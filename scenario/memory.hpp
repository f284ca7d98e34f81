// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"

#include <cstdint>

// Memory check of large scenarios. A mistyped, far too large robot count is reported before the
// machine starts to swap.

namespace rovernet {

/// Memory that this process may use [bytes]: the memory of the machine, or the limit of the process
/// (ulimit -v) if the limit is lower.
std::uint64_t available_memory();

/// Estimate of the memory that a run of the scenario needs for its robots [bytes]: 280 for each
/// robot at rest, 1000 for each moving robot, both measured. The memory for maps, traces and
/// messages is not included.
std::uint64_t robots_memory(const Scenario& scenario);

/// Checks the memory needed by the scenario's robots, before any robot is created. It is an error
/// if this memory exceeds `available`. Above 1 GB a notice is added to the scenario. Robots that
/// only a movement file names are not counted.
/// @param available  memory that the process may use [bytes]
/// @throws InputError at the [[robot]] that needs the most memory
void check_memory(Scenario& scenario, std::uint64_t available);

}  // namespace rovernet
