// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"
#include "scenario/scenario.hpp"

#include <string>
#include <string_view>
#include <vector>

// Notices about values that are valid but unlikely. A notice changes no result: the command prints
// it on standard error.

namespace rovernet {

/// Adds notices about valid but unlikely values of radios, switching times, payloads and message
/// starts: a frequency of 2.45 MHz, a bit rate that the standard lacks, a robot switched on while
/// it is on, a payload "64 B", robots that transmit at the same instants so that their frames
/// collide.
/// @throws InputError for a sensitivity above 0 dBm, surely a mistake: such a receiver receives
/// nothing
void note_unlikely(Scenario& scenario);

/// Adds notices about robots that start off the map, or in a wall of a world that is read with
/// `lenient` (in any other scene a start in a wall is an error later).
/// @param scene  scene of the scenario; null: an open field
void note_places(Scenario& scenario, const Scene* scene);

/// Adds notices about antennas that are so high that they lie in another storey than their robots.
/// @param scene  scene of the scenario; null: an open field
void note_antennas(Scenario& scenario, const Scene* scene);

/// Adds a notice if wall losses count twice: a coefficient N of raytrace_2007 above 22 includes the
/// walls of an average building, and the walls of the map are added.
/// @param scene  scene of the scenario; null: an open field
void note_walls_twice(Scenario& scenario, const Scene* scene);

/// Adds a notice if the model sums fields of paths (coherent) but walls are oblique to the map's
/// grid: the phases are wrong then.
/// @param scene  scene of the scenario; null: an open field
void note_coherent_slants(Scenario& scenario, const Scene* scene);

/// Adds one notice, with the first such wall, about walls without a material that are thicker than
/// 0.5 m, the limit of the model `rays`: such walls are furniture, pillars or shafts.
/// @param scene  scene of the scenario; null: an open field
void note_thick_walls(Scenario& scenario, const Scene* scene);

/// Adds notices about robots with their own propagation model if [study] varies [propagation]: the
/// study does not change their model.
void note_own_models(Scenario& scenario);

/// Rejects the model disc in commands that compare levels, since disc has no levels.
/// @param who  command or method that compares, for the message
/// @throws InputError if the model is disc
void refuse_disc(const Propagation& model, const Location& where, std::string_view who);

/// Adds a notice to the list, unless the list has it already.
void add_notice(std::vector<std::string>& notices, std::string notice);

}  // namespace rovernet
