// SPDX-License-Identifier: MIT
#pragma once

#include "scene/faces.hpp"
#include "scene/hollow_walls.hpp"
#include "scene/map_frame.hpp"
#include "scene/wall_index.hpp"
#include "scene/wall_thickness.hpp"
#include "sim/geometry.hpp"

#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

namespace rovernet {

/// Walls of one material on one map.
struct WallLayer {
    static constexpr double endless = std::numeric_limits<double>::infinity();

    MapFrame frame;
    std::vector<CellRectangle> rectangles;   ///< walls, disjoint, as made by solid_rectangles()
    std::shared_ptr<const WallIndex> walls;  ///< spatial index of the rectangles
    std::shared_ptr<const WallThickness> thickness = {};  ///< drawn thickness of the walls, by cell
    std::shared_ptr<const HollowWalls> hollows = {};      ///< hollow walls of the map
    std::shared_ptr<const Faces> faces = {};              ///< faces of all walls of the storey
    std::size_t material = 0;                             ///< index into Scene::materials()
    std::size_t storey = 0;                               ///< storey of the map; the lowest is 0
    double bottom = -endless;                             ///< height of the walls' lower end [m]
    double top = endless;  ///< height of the walls' upper end [m]; not part of the walls

    /// Whether the walls stand at all heights.
    bool is_endless() const { return bottom == -endless && top == endless; }
    /// Computes the passages of the segment a-b through the walls, in order from a, as if the walls
    /// extended over all heights.
    /// @param length  length of the segment [m]
    /// @param out     replaced by the passages
    void crossings(CellPoint a, CellPoint b, double length, std::vector<Crossing>& out) const {
        walls->crossings(a, b, length, out);
        for (Crossing& c : out) c.material = material;
    }
    /// Appends the passages of the segment a-b through the walls, in order from a.
    void append_crossings(Vec3 a, Vec3 b, std::vector<Crossing>& out) const;
};

}  // namespace rovernet
