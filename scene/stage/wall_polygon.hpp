// SPDX-License-Identifier: MIT
#pragma once

#include "scene/occupancy.hpp"
#include "scene/stage/world_model.hpp"
#include "scene/stage/worldfile.hpp"
#include "sim/error.hpp"
#include "sim/geometry.hpp"

#include <cstdint>
#include <vector>

namespace rovernet {

/// A closed outline on a model's body; z is 0.
struct WallPolygon {
    std::vector<Vec3> points;
    Location where;

    /// Four corners, with sides along the axes.
    bool is_box() const;
};

/// The outlines of a model as the file gives them, unscaled: polygon[i].point[j] of Stage 2,
/// block[i].point[j] of Stage 3 and the `block` children of Stage 3 and 4.
/// @throws InputError for a point that is missing or is no [x y]
std::vector<WallPolygon> wall_polygons(const WorldEntity& entity);

/// Stretches all outlines together, until the box around them fills `size`, its middle at (0, 0).
/// False, and nothing done, if that box has no width or no height.
bool fit(std::vector<WallPolygon>& polygons, const WorldSize& size);

/// The box around the points.
struct Extent {
    double x0 = 0;
    double y0 = 0;
    double x1 = 0;
    double y1 = 0;
};
Extent extent_of(const std::vector<Vec3>& points);

/// The inside of an outline (by the even-odd rule) as cells of at most `cell` [m] over its extent;
/// a cell is a wall if its middle is inside. An axis-parallel box is one cell.
/// The grid's origin is relative to the body.
OccupancyGrid filled(const WallPolygon& polygon, double cell);

/// Work that filled() has, in cells and edges looked at.
double filling_work(const WallPolygon& polygon, double cell);

}  // namespace rovernet
