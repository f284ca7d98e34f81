// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.hpp"
#include "sim/units.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace rovernet {

/// A step from a cell to one of its 8 neighbours.
struct CellStep {
    int column;
    int row;
};
/// The neighbours counter-clockwise from the right; opposite steps differ by 4.
inline constexpr std::array<CellStep, 8> cell_steps{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

/// The cells of a map where a round robot may stand, and the steps that it may take between them.
struct FreeSpace {
    /// @param radius  [m], >= 0
    FreeSpace(const Scene& scene, Meters radius);

    /// Flag of each cell, rows from the bottom: 1 if the centre keeps the radius from every
    /// obstacle.
    std::vector<std::uint8_t> free;
    /// Bits of each cell: bit d is set if the robot may go straight to the centre of neighbour
    /// cell_steps[d]. A diagonal step needs both cells beside it: no corner is cut.
    std::vector<std::uint8_t> steps;
    /// Number of each cell: that of the part of the map that steps join it to; -1 if it is not
    /// free.
    std::vector<std::int32_t> part;
};

}  // namespace rovernet
