// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"

#include <string>
#include <vector>

// Checks of names and addresses, made once the whole scenario is read.

namespace rovernet {

/// Checks the names in a scenario: robots have different names, and every name that the scenario
/// uses (a leader, a sender, a receiver) belongs to a robot.
/// @throws InputError at the first wrong name, with a suggestion
void check_names(const Scenario& scenario);

/// Names of all robots in the order of their ids in the network: first the robots of [[robot]]
/// tables, then the robots that only the movement file names.
std::vector<std::string> robot_names(const Scenario& scenario);

/// Checks that no two robots of a scenario have the same ip or the same mac. Robots of a Stage
/// world are not checked: Stage allows equal addresses, and stage_document() adds a notice.
/// @throws InputError at the second robot with an address; the message names both robots
void check_addresses(const Scenario& scenario);

}  // namespace rovernet
