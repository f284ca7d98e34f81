// SPDX-License-Identifier: MIT
#pragma once

#include "scene/occupancy.hpp"

#include <vector>

namespace rovernet {

/// Grid for path planning on several maps: a cell is free if no obstacle of any map enters it.
///
/// The cell size is the smallest of all maps with more than one cell, enlarged if there would be
/// more than 4 million cells; the placement is that of the first such map. A single wall (a map of
/// one cell) blocks whole cells here; clearance and passability of the scene remain exact.
/// @param maps  one or more, each with cells
OccupancyGrid planning_grid(const std::vector<OccupancyGrid>& maps);

}  // namespace rovernet
