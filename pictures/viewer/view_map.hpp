// SPDX-License-Identifier: MIT
#pragma once

#include "network/settings.hpp"
#include "pictures/viewer/motion_columns.hpp"
#include "scenario/scenario.hpp"

namespace rovernet {

class ViewFile;

/// Entry `map` of a view file's head: bounds, storeys, materials, doors and stairs. Adds the
/// columns `walls` to the file.
/// @param scenario  scenario with its map loaded
/// @param settings  settings of a network for the scenario
/// @param motion    rectangle around the robots' legs, which the bounds include
Table view_map(const Scenario& scenario, const NetworkSettings& settings,
               const MotionColumns::Bounds& motion, ViewFile& file);

/// Entry `colors` of a view file's head: the colours and fills of the pictures of `rovernet draw`.
Table view_colors();

}  // namespace rovernet
