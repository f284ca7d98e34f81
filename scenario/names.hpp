// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"

namespace rovernet {

/// Every robot has a name of its own, and every name that the scenario uses is a robot's.
/// @throws InputError at the first that is not so, with a suggestion
void check_names(const Scenario& scenario);

/// No two robots were given one ip or one mac. Not asked of Stage worlds, where it was allowed and
/// is a notice.
/// @throws InputError naming both
void check_addresses(const Scenario& scenario);

}  // namespace rovernet
