// SPDX-License-Identifier: MIT
#pragma once

#include "network/settings.hpp"
#include "scenario/scenario.hpp"
#include "sim/units.hpp"

#include <string>
#include <vector>

// Small changes to a scenario that no result should hang on: places known to a centimetre, another
// drawing of the same walls, materials known to 3 dB.

namespace rovernet {

/// A scenario with one small change to what radio sees. Robots, their ways and everything random
/// are those of the scenario as given: robots keep to its own maps, the changed maps attenuate.
struct Perturbation {
    std::string name;     ///< such as "resolution x2"
    Scenario scenario;    ///< with the change in it
    Meters moved{0};      ///< displacement of each antenna [m]; 0: the change is another
    std::string nothing;  ///< why there is nothing to change; empty: there is

    /// Settings of a network for the perturbed scenario.
    /// @throws InputError as network_settings()
    NetworkSettings settings() const;
};

/// The perturbations of a scenario, in this order:
///
///   1 cm, 1 um                   each antenna is displaced by that much, see Displaced
///   resolution x2, x0.5          cells of the maps split in four, or four joined into one: see
///                                scene/redrawing.hpp
///   walls outlined, filled       thick walls hollow, hollow ones up to 1 m wide solid
///   MATERIAL +3 dB, -3 dB        loss of a crossing, not below 0 dB; up to 8 materials one by one,
///                                more of them all at once
///
/// A material with a loss per metre alone changes by 3 dB over the median drawn thickness of its
/// walls. Walls that follow the model change together, by its wall_factor, light_wall and
/// heavy_wall. On an open field, or if no model sees walls, there are only the first two. Maps of
/// more than 16 million cells are not redrawn.
/// @param scenario  with its walls loaded, as by load_scenario()
std::vector<Perturbation> perturbations(const Scenario& scenario);

}  // namespace rovernet
