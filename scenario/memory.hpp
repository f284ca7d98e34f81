// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"

#include <cstdint>

namespace rovernet {

/// Memory that this process may have [bytes]: the machine's, or what a limit leaves (ulimit -v).
std::uint64_t available_memory();

/// About the memory that a run of the scenario takes for its robots alone [bytes].
std::uint64_t robots_memory(const Scenario& scenario);

/// Before anything is made of the robots: too many of them are refused, and very many noticed.
/// @param available  [bytes]
/// @throws InputError at the robots that take most of it
void check_memory(Scenario& scenario, std::uint64_t available);

}  // namespace rovernet
