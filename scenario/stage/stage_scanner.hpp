// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "scene/stage/world_model.hpp"
#include "scene/stage/worldfile.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// Range finders of a Stage robot: each `laser` and `ranger` that it carries, in the order of the
/// file, as tables for the `scan` of a [[robot]]. Those of positions that it carries are not its
/// own. Values have their places in the world.
///
///   laser                        kind "laser": samples (180) over fov (180), up to range_max (8 m)
///   ranger with a sensor         kind "ranger": samples (1) over fov (0.1 rad), up to range (5 m)
///   ranger with several sensors  kind "ranger": a ring of one beam each
///   ranger without a sensor      kind "sonar": scount (16) beams at spose[i], up to sview (5 m);
///                                evenly all round if there is no spose at all
///
/// What is in brackets is Stage's default. The pose of each, and update_interval [ms], count, too.
/// @param notices  appended: what is read otherwise than Stage would, "file:line: text"
/// @throws InputError for values of the wrong kind
Array stage_scanners(const WorldEntity& robot, const WorldUnits& units,
                     std::vector<std::string>& notices);

/// Whether stage_scanners() makes a range finder of a model.
bool is_stage_scanner(const WorldEntity& model);

}  // namespace rovernet
