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

/// Names of all robots in the order of their ids in the network: those of [[robot]], then those
/// that only the movement file has.
std::vector<std::string> robot_names(const Scenario& scenario);

/// Checks the addresses in a scenario: no two robots have the same ip or the same mac. Stage worlds
/// are not checked: Stage allows equal addresses, and stage_document() gives a notice.
/// @throws InputError at the second robot, naming both
void check_addresses(const Scenario& scenario);

}  // namespace rovernet
