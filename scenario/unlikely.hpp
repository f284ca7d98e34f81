// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"

// Values that are in their range and hardly meant. A notice goes to the user and changes nothing:
// the command prints it on standard error.

namespace rovernet {

/// Notices radios, switching times and payloads that are each in their range and hardly meant: a
/// frequency of 2.45 MHz, a rate that the standard does not have, a robot that is switched on and
/// is on already, a payload "64 B".
/// @throws InputError for a sensitivity above 0 dBm, which cannot be meant: such a receiver hears
/// nothing
void note_unlikely(Scenario& scenario);

/// Notices robots that start beyond the map, or in a wall of a world that is read leniently (in any
/// other that is an error later).
/// @param scene  the scenario's; null: an open field
void note_places(Scenario& scenario, const Scene* scene);

/// Notices antennas that are on another storey than their robots: only their height puts them
/// there.
/// @param scene  the scenario's; null: an open field
void note_antennas(Scenario& scenario, const Scene* scene);

/// Notices walls that count twice: those of the map, and those of a usual building that the
/// coefficient N of raytrace_2007 holds where it is above 22.
/// @param scene  the scenario's; null: an open field
void note_walls_twice(Scenario& scenario, const Scene* scene);

/// Notices sums of fields where walls are not along the cells of the map: their phases are wrong.
/// @param scene  the scenario's; null: an open field
void note_coherent_slants(Scenario& scenario, const Scene* scene);

/// Notices walls without a material that are drawn thicker than the model `rays` takes them, half a
/// metre: what is so thick is furniture, a pillar or a shaft. One notice, with the first place.
/// @param scene  the scenario's; null: an open field
void note_thick_walls(Scenario& scenario, const Scene* scene);

/// Notices robots that choose a propagation model of their own where [study] varies [propagation]:
/// they are the same at every point.
void note_own_models(Scenario& scenario);

/// Adds a notice, unless it is there already.
void add_notice(std::vector<std::string>& notices, std::string notice);

}  // namespace rovernet
