// SPDX-License-Identifier: MIT
#pragma once

#include "scene/occupancy.hpp"
#include "scene/stage/world_model.hpp"
#include "scene/stage/worldfile.hpp"
#include "sim/error.hpp"
#include "sim/geometry.hpp"

#include <vector>

namespace rovernet {

/// Closed polygon: an outline of a Stage model's body, in the coordinates of the body; z is 0.
struct WallPolygon {
    std::vector<Vec3> points;
    Location where;

    /// Whether the outline is a rectangle with sides parallel to the axes.
    bool is_box() const;
};

/// Outlines of a Stage model as in the world file, unscaled: polygon[i].point[j] of Stage 2,
/// block[i].point[j] of Stage 3, and the `block` children of Stage 3 and 4.
/// @throws InputError for a point that is missing or not of the form [x y]
std::vector<WallPolygon> wall_polygons(const WorldEntity& entity);

/// Scales all outlines of a model together, so that their common bounding box has the given size
/// and its centre is at (0, 0). If the box has no width or no height, nothing is changed.
/// @return whether the outlines were scaled
bool fit(std::vector<WallPolygon>& polygons, const WorldSize& size);

/// Bounding box of points.
struct Extent {
    double x0 = 0;
    double y0 = 0;
    double x1 = 0;
    double y1 = 0;
};
Extent extent_of(const std::vector<Vec3>& points);

/// Grid of the interior of an outline, by the even-odd rule. The sides of its cells are at most
/// `cell` [m]. A cell is a wall if its centre is inside. An axis-parallel box becomes one cell. The
/// origin of the grid is relative to the model's body.
OccupancyGrid filled(const WallPolygon& polygon, double cell);

/// Cost of filled(): number of cells and edges that filled() visits.
double filling_work(const WallPolygon& polygon, double cell);

}  // namespace rovernet
