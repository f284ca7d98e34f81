// SPDX-License-Identifier: MIT
#pragma once

#include "scene/material.hpp"
#include "scene/occupancy.hpp"
#include "scene/worldfile.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// The walls of a Stage world: one grid for each bitmap and each box, in the order of the file.
struct StageWalls {
    std::vector<OccupancyGrid> grids;
    /// One for each colour of a wall model, named like the colour; none gives a loss of its own.
    std::vector<Material> materials;
    std::vector<std::string> notices;
};

/// Stage's rules: a pixel is a wall if its first channel is at most 127; the bounding box of the
/// walls, not the picture, is scaled to the model's size; boxes are walls from edge to edge; a
/// boundary is four walls of 0.01 m. Robots, sensors and models with laser_return 0 are no walls.
/// @throws InputError for a bitmap that is missing (unless lenient) or damaged
StageWalls stage_walls(const WorldFile& world, const WorldOptions& options);

}  // namespace rovernet
