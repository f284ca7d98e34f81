// SPDX-License-Identifier: MIT
#pragma once

#include "scene/occupancy.hpp"

#include <vector>

namespace rovernet {

/// Grid for planning ways among several maps: free where no obstacle of any map enters the cell.
///
/// Its cells are as small as the finest map's with more than one cell, and lie as those of the
/// first such map do; at most 4 million, then larger. A lone wall (a map of one cell) stays a wall,
/// but takes up whole cells here; clearance and passability of the scene are exact.
/// @param maps  at least one, each with cells
OccupancyGrid planning_grid(const std::vector<OccupancyGrid>& maps);

}  // namespace rovernet
