// SPDX-License-Identifier: MIT
#pragma once

#include "network/settings.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "sim/units.hpp"

#include <string>
#include <vector>

// Small changes to a scenario that should not change results: antenna positions known to 1 cm, a
// different drawing of the same walls, materials known to 3 dB.

namespace rovernet {

/// Scenario in which only the radio model sees a changed world (antenna positions, walls,
/// materials). Robots still move on the original map, and all random draws are the same.
struct Perturbation {
    std::string name;     ///< name of the perturbation, such as "resolution x2"
    Scenario scenario;    ///< scenario with the perturbation applied
    Meters moved{0};      ///< displacement of each antenna [m]; 0: the antennas are not displaced
    std::string nothing;  ///< reason why the scenario is not perturbed; empty: perturbed

    /// Settings of a Network for the perturbed scenario.
    /// @throws InputError as network_settings()
    NetworkSettings settings() const;
};

/// Perturbations (small changes) of a scenario, in this order:
///
///   1 cm, 1 um                   each antenna is displaced by this distance, see Displaced
///   resolution x2, x0.5          cells of the maps split in four, or four joined into one: see
///                                scene/redrawing.hpp
///   walls outlined, filled       thick walls made hollow; hollow walls up to 1 m wide made solid
///   MATERIAL +3 dB, -3 dB        loss of a wall crossing changed, not below 0 dB; up to 8
///                                materials one by one, more materials all together
///
/// If a material has only a loss per metre, this loss changes by 3 dB at the median drawn thickness
/// of the material's walls. Walls without a material change together, by the model's wall_factor,
/// light_wall and heavy_wall. On an open field, or if the model ignores walls, only the first two
/// perturbations exist. Maps with more than 16 million cells are not redrawn.
/// @param scenario  scenario with its walls loaded, as by load_scenario()
std::vector<Perturbation> perturbations(const Scenario& scenario);

}  // namespace rovernet
