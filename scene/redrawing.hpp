// SPDX-License-Identifier: MIT
#pragma once

#include "scene/occupancy.hpp"
#include "sim/units.hpp"

// Alternative drawings of the same walls. A result that changes with the drawing is not reliable.
//
//     const Scene finer(split_cells(scene.grid()), scene.materials());

namespace rovernet {

/// Map with each cell split into 2 x 2 cells: the same walls in cells of half the size.
OccupancyGrid split_cells(const OccupancyGrid& map);

/// Map with blocks of 2 x 2 cells joined to one cell, from the lower left. A joined cell is
/// occupied if any of the four cells is occupied, or else unknown if any of them is unknown. It has
/// the material of its first occupied cell, by row and column. Walls become thicker by up to one
/// cell on each side. A map of one row or column is unchanged.
OccupancyGrid join_cells(const OccupancyGrid& map);

/// Map with its walls drawn as outlines: an occupied cell becomes free if all its 8 neighbours are
/// occupied. Walls of one or two cells are unchanged; the outlines have no gaps.
OccupancyGrid outline_walls(const OccupancyGrid& map);

/// Map with hollow walls filled: a free area becomes occupied if walls enclose it and it is nowhere
/// wider than `widest` [m], to within a cell. Each filled cell gets the material of the wall that
/// is nearest in steps between cells (also diagonal ones). Walls that touch only at a corner also
/// enclose an area.
OccupancyGrid fill_walls(const OccupancyGrid& map, Meters widest);

}  // namespace rovernet
