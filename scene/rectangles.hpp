// SPDX-License-Identifier: MIT
#pragma once

#include "scene/occupancy.hpp"

#include <cstdint>
#include <vector>

namespace rovernet {

/// Block of map cells, half open: columns [column0, column1), rows [row0, row1).
struct CellRectangle {
    int column0 = 0;
    int row0 = 0;
    int column1 = 0;
    int row1 = 0;
    friend constexpr bool operator==(CellRectangle, CellRectangle) = default;
};

/// Kind of map cells that solid_rectangles() covers with rectangles.
enum class Solid {
    walls,     ///< occupied cells, which attenuate radio
    obstacles  ///< occupied and unknown cells, which block robots
};

/// Covers the solid cells exactly with disjoint rectangles.
///
/// The algorithm is greedy and deterministic. From the lowest, then leftmost uncovered cell, it
/// takes the larger of two rectangles: one grown first right and then up, the other first up and
/// then right. No rectangle can grow further right or up.
std::vector<CellRectangle> solid_rectangles(const OccupancyGrid& grid, Solid solid);

/// Selection of the wall cells of one material.
struct WallsOf {
    std::uint8_t material;  ///< index into Scene::materials()
};
std::vector<CellRectangle> solid_rectangles(const OccupancyGrid& grid, WallsOf walls);

}  // namespace rovernet
