// SPDX-License-Identifier: MIT
#pragma once

#include "scene/materials/material.hpp"
#include "scene/occupancy.hpp"
#include "scene/stage/worldfile.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// Walls of a Stage world: one grid for each bitmap, box, outline and boundary wall, in the order
/// of the file. Grids may touch and overlap.
struct StageWalls {
    std::vector<OccupancyGrid> grids;  ///< walls; OccupancyGrid::material: index into `materials`
    /// Materials of the walls: one for each colour of a wall model, named like the colour. The
    /// propagation model gives their loss.
    std::vector<Material> materials;
    std::vector<std::string> notices;  ///< notices for the user, each "file:line: text"
};

/// Walls of a Stage world, made of every `model` and its parts, but not of robots and their parts.
/// The rules are those of Stage:
///
/// A pixel of a bitmap is a wall if its first channel is at most 127. The bounding box of these
/// pixels, not the image, is scaled to the model's size and centred on its pose and origin. A model
/// without bitmap and outline is a solid box, unless noblocks is 1. Outlines (polygons, blocks) are
/// scaled together to the model's size; axis-parallel boxes are exact, other shapes become cells of
/// at most 0.02 m, with a notice. boundary 1 adds four walls of 0.01 m just inside the model's
/// size. Walls are infinitely high. The ground around the walls is free for robots.
///
/// A model with laser_return <= 0 (Stage 2 and 3) or ranger_return < 0 (Stage 4) is not a wall: the
/// radio of Stage's wifi of 2007 passed through models that a laser passes through. A model without
/// a colour is red, as in Stage.
/// @throws InputError for a bitmap that is missing (unless lenient) or damaged, for values of the
///         wrong type, and for more than 256 million pixels and cells in total
StageWalls stage_walls(const WorldFile& world, const WorldOptions& options);

}  // namespace rovernet
