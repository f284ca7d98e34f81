// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"
#include "scenario/tables/reader.hpp"

// The list [[robot]] of a scenario, beside the robots of a Stage world and of a movement file.

namespace rovernet {

/// Reads [[robot]] of a document, to which the robots of the world have been added. Robots that the
/// movement file places need no place there; other places of these robots get a notice.
/// @throws InputError at the first mistake
void read_robots(TableReader& document, Scenario& out);

/// Checks that there is a robot, or at least a map if a report of the scene needs no robots.
/// @throws InputError with the notices of the world, which may tell the reason
void check_robots(TableReader& document, const Scenario& scenario, bool needs_robots);

}  // namespace rovernet
