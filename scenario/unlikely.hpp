// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"

namespace rovernet {

/// Looks for values that each stand in their range and are hardly meant together: a notice each.
/// @throws InputError for one that cannot be meant: a receiver that hears nothing
void note_unlikely(Scenario& scenario);

/// Notices robots that start beyond the map, or in a wall of a world that is read leniently.
/// @param scene  the scenario's; null: an open field
void note_places(Scenario& scenario, const Scene* scene);

/// Notices robots that choose a propagation model of their own where [study] varies [propagation]:
/// they are the same at every point.
void note_own_models(Scenario& scenario);

/// Adds a notice, unless it is there.
void add_notice(std::vector<std::string>& notices, std::string notice);

}  // namespace rovernet
