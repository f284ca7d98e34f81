// SPDX-License-Identifier: MIT
#pragma once

#include "scene/occupancy.hpp"

#include <cstdint>
#include <vector>

namespace rovernet {

/// A block of cells, half open: columns [column0, column1), rows [row0, row1).
struct CellRectangle {
    int column0 = 0;
    int row0 = 0;
    int column1 = 0;
    int row1 = 0;
    friend constexpr bool operator==(CellRectangle, CellRectangle) = default;
};

/// Cells that make up a set of rectangles.
enum class Solid {
    walls,     ///< occupied cells: what radio sees
    obstacles  ///< occupied and unknown cells: where robots must not go
};

/// Cuts the solid cells into disjoint rectangles that cover them exactly.
///
/// Greedy and deterministic: from the lowest, then leftmost, cell not covered yet, the larger of
/// the rectangle grown right then up and the one grown up then right. None can grow right or up.
std::vector<CellRectangle> solid_rectangles(const OccupancyGrid& grid, Solid solid);

/// Cells that are walls of one material.
struct WallsOf {
    std::uint8_t material;  ///< index into the scene's materials
};
std::vector<CellRectangle> solid_rectangles(const OccupancyGrid& grid, WallsOf walls);

}  // namespace rovernet
