// SPDX-License-Identifier: MIT
#pragma once

#include "scene/occupancy.hpp"
#include "scene/stage/world_model.hpp"
#include "scene/stage/worldfile.hpp"
#include "sim/error.hpp"
#include "sim/geometry.hpp"

#include <vector>

namespace rovernet {

/// Closed outline on a model's body; z is 0.
struct WallPolygon {
    std::vector<Vec3> points;
    Location where;

    /// Whether the outline is a rectangle with sides parallel to the axes.
    bool is_box() const;
};

/// Outlines of a model as in the file, unscaled: polygon[i].point[j] of Stage 2, block[i].point[j]
/// of Stage 3 and the `block` children of Stage 3 and 4.
/// @throws InputError for a point that is missing or not of the form [x y]
std::vector<WallPolygon> wall_polygons(const WorldEntity& entity);

/// Scales all outlines together, so that their bounding box fills `size` and is centred at (0, 0).
/// Returns false, and changes nothing, if the box has no width or no height.
bool fit(std::vector<WallPolygon>& polygons, const WorldSize& size);

/// Bounding box of points.
struct Extent {
    double x0 = 0;
    double y0 = 0;
    double x1 = 0;
    double y1 = 0;
};
Extent extent_of(const std::vector<Vec3>& points);

/// Interior of an outline (by the even-odd rule) as cells of at most `cell` [m] over its extent; a
/// cell is a wall if its centre is inside. An axis-parallel box is one cell. The grid's origin is
/// relative to the body.
OccupancyGrid filled(const WallPolygon& polygon, double cell);

/// Cost of filled(): number of cells and edges that it visits.
double filling_work(const WallPolygon& polygon, double cell);

}  // namespace rovernet
