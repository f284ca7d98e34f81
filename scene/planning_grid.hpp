// SPDX-License-Identifier: MIT
#pragma once

#include "scene/occupancy.hpp"

#include <vector>

namespace rovernet {

/// Grid for path planning on several maps: a cell is free if no obstacle of any map enters it.
///
/// The cell size is the smallest cell size of all maps with more than one cell. It is enlarged if
/// the grid would have more than 4 million cells. The grid has the axes of the first such map. A
/// map of one cell (a single wall) blocks whole cells of the grid. Clearance and passability of the
/// scene do not depend on this grid and remain exact.
/// @param maps  at least one map, each with cells
OccupancyGrid planning_grid(const std::vector<OccupancyGrid>& maps);

}  // namespace rovernet
