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

/// The walls of one material on one map.
struct WallLayer {
    static constexpr double endless = std::numeric_limits<double>::infinity();

    MapFrame frame;
    std::vector<CellRectangle> rectangles;   ///< disjoint, as few as the map's cutting gives
    std::shared_ptr<const WallIndex> walls;  ///< of these rectangles
    std::shared_ptr<const WallThickness> thickness = {};  ///< of these walls
    std::shared_ptr<const HollowWalls> hollows = {};      ///< of the map
    std::shared_ptr<const Faces> faces = {};              ///< of all walls of the storey
    std::size_t material = 0;                             ///< index into the scene's materials
    std::size_t storey = 0;                               ///< of the map, the lowest is 0
    double bottom = -endless;                             ///< [m] the walls stand from here ...
    double top = endless;                                 ///< ... to here, which is above them

    /// They stand at all heights.
    bool is_endless() const { return bottom == -endless && top == endless; }
    /// Writes the crossings of a segment that is `length` [m] long, in order from a, as if the
    /// walls stood at all heights.
    /// @param out  emptied first
    void crossings(CellPoint a, CellPoint b, double length, std::vector<Crossing>& out) const {
        walls->crossings(a, b, length, out);
        for (Crossing& c : out) c.material = material;
    }
    /// Appends the crossings of the segment, in order from a.
    void append_crossings(Vec3 a, Vec3 b, std::vector<Crossing>& out) const;
};

}  // namespace rovernet
