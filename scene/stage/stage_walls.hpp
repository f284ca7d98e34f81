// SPDX-License-Identifier: MIT
#pragma once

#include "scene/materials/material.hpp"
#include "scene/occupancy.hpp"
#include "scene/stage/worldfile.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// The walls of a Stage world: one grid for each bitmap, box, outline and boundary wall, in the
/// order of the file. Grids may touch and overlap.
struct StageWalls {
    std::vector<OccupancyGrid> grids;  ///< grids, whose `material` is an index into `materials`
    /// Materials, one for each colour of a wall model, named like the colour; none gives a loss of
    /// its own.
    std::vector<Material> materials;
    std::vector<std::string> notices;  ///< each "file:line: text"
};

/// Stage's rules, for every `model` and its parts, robots and what they carry left out:
///
/// A pixel of a bitmap is a wall if its first channel is at most 127. The box around these pixels,
/// not the picture, is scaled to the model's size, and is centred on its pose and origin. A model
/// without a bitmap and an outline is a box, solid from edge to edge, unless noblocks is 1.
/// Outlines (polygons, blocks) are scaled together to the model's size; axis-parallel boxes are
/// exact, others become cells of at most 0.02 m, with a notice. boundary 1 adds four walls of
/// 0.01 m just inside the model's size. Walls are infinitely high.
///
/// A model with laser_return or ranger_return at or below 0 is no wall: what a laser passes, the
/// 2007 radio passed. A model without a colour is red, as in Stage.
/// @throws InputError for a bitmap that is missing (unless lenient) or damaged, for values of the
/// wrong kind, and above 256 million pixels and cells in all
StageWalls stage_walls(const WorldFile& world, const WorldOptions& options);

}  // namespace rovernet
