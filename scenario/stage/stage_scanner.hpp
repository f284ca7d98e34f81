// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "scene/stage/world_model.hpp"
#include "scene/stage/worldfile.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// Range finders of a Stage robot: each `laser` and `ranger` on the robot, in the order of the
/// file, as tables for the `scan` of a [[robot]]. Range finders of a nested `position` are not
/// included. Values have their positions in the world file.
///
///   laser                        kind "laser": samples (180) over fov (180), up to range_max (8 m)
///   ranger with a sensor         kind "ranger": samples (1) over fov (0.1 rad), up to range (5 m)
///   ranger with several sensors  kind "ranger": a ring of one beam each
///   ranger without a sensor      kind "sonar": scount (16) beams at spose[i], up to sview (5 m);
///                                evenly spaced all round if no spose is given
///
/// Numbers in parentheses are Stage's defaults. The pose of each range finder and update_interval
/// [ms] are read, too.
/// @param notices  receives notices "file:line: text" about keys that Stage interprets differently
/// @throws InputError for values of the wrong kind
Array stage_scanners(const WorldEntity& robot, const WorldUnits& units,
                     std::vector<std::string>& notices);

/// Whether stage_scanners() reads a model of a Stage world as a range finder.
bool is_stage_scanner(const WorldEntity& model);

}  // namespace rovernet
