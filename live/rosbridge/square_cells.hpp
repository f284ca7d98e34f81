// SPDX-License-Identifier: MIT
#pragma once

#include "scene/occupancy.hpp"

namespace rovernet {

/// Map with square cells, for messages that have a single size for cells, such as
/// nav_msgs/OccupancyGrid. A new cell is occupied if it overlaps any occupied cell, or else unknown
/// if it overlaps any unknown cell. So walls become thicker by less than one new cell on each side.
/// Materials are left out.
///
/// The side of a new cell is at most the shorter side of a cell of `map`. If a side down to eight
/// ninths of that length divides both sides of the map into whole cells, the new map has exactly
/// the extent of `map`. Otherwise its last row or column sticks out by less than a new cell. A map
/// of square cells is unchanged. A new map of more than max_image_pixels cells gets larger cells.
OccupancyGrid square_cells(const OccupancyGrid& map);

}  // namespace rovernet
