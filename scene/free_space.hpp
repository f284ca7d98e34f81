// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.hpp"
#include "sim/units.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace rovernet {

/// Step from a cell to one of its 8 neighbours.
struct CellStep {
    int column;
    int row;
};
/// Steps to the neighbours, counter-clockwise from the right; the indices of opposite steps differ
/// by 4.
inline constexpr std::array<CellStep, 8> cell_steps{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

/// Cells of a map where a round robot may stand, and allowed steps between them.
struct FreeSpace {
    /// @param radius  radius of the robot [m], >= 0
    FreeSpace(const Scene& scene, Meters radius);

    /// Flag of each cell, rows from the bottom: 1 if the distance of the cell's centre to every
    /// obstacle is at least the radius.
    std::vector<std::uint8_t> free;
    /// Step bits of each cell: bit d is set if the robot may move straight to the centre of
    /// neighbour cell_steps[d]. A diagonal step needs both adjacent cells to be free, so no corner
    /// is cut.
    std::vector<std::uint8_t> steps;
    /// Component number of each cell: cells connected by steps share a number; -1 if the cell is
    /// not free.
    std::vector<std::int32_t> part;
};

}  // namespace rovernet
