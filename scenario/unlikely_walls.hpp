// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"

// Notices about walls of the map that the chosen propagation models treat differently from what
// the user may expect.

namespace rovernet {

/// Adds a notice if wall losses are counted twice: a coefficient N of the model raytrace_2007 above
/// 22 includes the walls of an average building, but the losses of the map's walls are added.
/// @param scene  scene of the scenario; null: an open field
void note_walls_twice(Scenario& scenario, const Scene* scene);

/// Adds a notice if the model `rays` adds the fields of paths with their phases (sum = "coherent")
/// although walls are oblique to the map's grid, since the phases are wrong then.
/// @param scene  scene of the scenario; null: an open field
void note_coherent_slants(Scenario& scenario, const Scene* scene);

/// Adds one notice about walls without a material that are thicker than the model counts: more than
/// 0.5 m with `rays`, the most that it takes for a wall, and more than 0.8 m and two cells of
/// the map with `multi_wall`, which gives each wall the same loss. Such walls may be furniture,
/// pillars or shafts. The notice names the first one.
/// @param scene  scene of the scenario; null: an open field
void note_thick_walls(Scenario& scenario, const Scene* scene);

}  // namespace rovernet
