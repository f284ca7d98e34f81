// SPDX-License-Identifier: MIT
#pragma once

#include "scene/occupancy.hpp"
#include "sim/geometry.hpp"
#include "sim/units.hpp"

#include <functional>
#include <vector>

// Maps for validations, defined as shapes that can be rasterised with any cell size.

namespace rovernet {

/// Axis-parallel rectangle [m].
struct DrawnRectangle {
    Vec3 low, high;

    bool contains(Vec3 p) const {
        return p.x >= low.x && p.x < high.x && p.y >= low.y && p.y < high.y;
    }
};

/// Building of rectangular walls, with doors cut out of the walls.
struct DrawnBuilding {
    double width = 0, depth = 0;  ///< size of the building [m], from (0, 0)
    std::vector<DrawnRectangle> walls = {}, doors = {};

    bool is_wall(Vec3 p) const;
};

/// Office of 40 m x 20 m: four rows of eight rooms along two corridors; inner walls 15 cm, outer
/// walls 30 cm thick; a door in every room.
DrawnBuilding drawn_office();
/// Cell size [m] of an occupancy grid that represents drawn_office() exactly.
inline constexpr Meters office_cell{0.05};

/// Whether a point is rock in a cave of 60 m x 40 m: seven chambers joined by winding galleries, at
/// least 2.4 m wide.
bool is_rock(Vec3 p);
inline constexpr double cave_width = 60, cave_depth = 40;  // size of the cave [m]

/// Occupancy grid of width x depth [m], from (0, 0), with square cells of size `cell` [m]. A grid
/// cell is occupied if `is_wall` is true for its centre.
OccupancyGrid drawn_map(double width, double depth, double cell,
                        const std::function<bool(Vec3)>& is_wall);

}  // namespace rovernet
