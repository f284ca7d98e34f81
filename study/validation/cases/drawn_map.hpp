// SPDX-License-Identifier: MIT
#pragma once

#include "scene/occupancy.hpp"
#include "sim/geometry.hpp"
#include "sim/units.hpp"

#include <functional>
#include <vector>

// Maps of our own that the validations run on, as shapes that can be drawn in cells of any size.

namespace rovernet {

/// Upright rectangle [m].
struct DrawnRectangle {
    Vec3 low, high;

    bool contains(Vec3 p) const {
        return p.x >= low.x && p.x < high.x && p.y >= low.y && p.y < high.y;
    }
};

/// Building of rectangles: walls, and the doors that are cut out of them.
struct DrawnBuilding {
    double width = 0, depth = 0;  ///< [m] from (0, 0)
    std::vector<DrawnRectangle> walls = {}, doors = {};

    bool is_wall(Vec3 p) const;
};

/// Office of 40 m x 20 m: four rows of eight rooms along two corridors, inner walls of 15 cm and
/// outer ones of 30 cm, a door in every room.
DrawnBuilding drawn_office();
/// Cells that draw the office without loss.
inline constexpr Meters office_cell{0.05};

/// Cave of 60 m x 40 m: seven chambers in the rock, and the winding galleries between them, 2.4 m
/// wide or more.
bool is_rock(Vec3 p);
inline constexpr double cave_width = 60, cave_depth = 40;  // [m]

/// Map in square cells of a size [m], from (0, 0): a cell is a wall if its middle is one.
OccupancyGrid drawn_map(double width, double depth, double cell,
                        const std::function<bool(Vec3)>& is_wall);

}  // namespace rovernet
