// SPDX-License-Identifier: MIT
#pragma once

#include "scene/occupancy.hpp"
#include "sim/units.hpp"

// Other drawings of the same walls: what depends on the drawing shows where a result does not hold.
//
//     const Scene finer(split_cells(scene.grid()), scene.materials());

namespace rovernet {

/// Map with each cell split into 2 x 2: the same walls in cells of half the size.
OccupancyGrid split_cells(const OccupancyGrid& map);

/// Map with 2 x 2 cells joined, from the lower left: the cell is occupied if any of the four is, or
/// else unknown if any is. Its material is that of the first occupied one, by row and column. Walls
/// become thicker by up to a cell on each side. A map of one row or column stays as it is.
OccupancyGrid join_cells(const OccupancyGrid& map);

/// Map with its walls drawn as outlines: occupied cells become free if all their 8 neighbours are
/// occupied. Walls of one or two cells stay as they are; the outlines have no holes.
OccupancyGrid outline_walls(const OccupancyGrid& map);

/// Map with hollow walls filled: an area becomes occupied if walls enclose it and it is nowhere
/// wider than `widest` [m], to a cell. Its cells get the material of the wall that is fewest steps
/// away, diagonal ones among them. Cells that touch at a corner enclose.
OccupancyGrid fill_walls(const OccupancyGrid& map, Meters widest);

}  // namespace rovernet
