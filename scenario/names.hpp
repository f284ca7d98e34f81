// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"

// Names and addresses of a scenario, checked once all of it is read.

namespace rovernet {

/// Checks names: every robot has one of its own, and every name that the scenario uses (a leader, a
/// sender, a receiver) is a robot's.
/// @throws InputError at the first that is not so, with a suggestion
void check_names(const Scenario& scenario);

/// Checks addresses: no two robots were given one ip or one mac. A Stage world is left alone: it
/// was allowed there, and stage_document() gives a notice.
/// @throws InputError at the second robot, naming both
void check_addresses(const Scenario& scenario);

}  // namespace rovernet
