// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"

#include <cstdint>

// Memory check of large scenarios: a robot count with a zero too many is reported before the
// machine swaps.

namespace rovernet {

/// Memory that this process may use [bytes]: memory of the machine, or the limit (ulimit -v) if it
/// is lower.
std::uint64_t available_memory();

/// Estimate of the memory that a run of the scenario takes for its robots alone [bytes]: 280 for
/// each robot at rest, 1000 for each moving robot. Both numbers were measured; maps, traces and
/// messages need more.
std::uint64_t robots_memory(const Scenario& scenario);

/// Checks the memory for the robots before any robot is created. More than the available memory is
/// an error; more than 1 GB gives a notice. Robots that only a movement file names do not count.
/// @param available  memory that the process may use [bytes]
/// @throws InputError at the [[robot]] that needs the most memory
void check_memory(Scenario& scenario, std::uint64_t available);

}  // namespace rovernet
