// SPDX-License-Identifier: MIT
#pragma once

#include "scene/map_frame.hpp"
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
/// Steps from a cell to its 8 neighbours, counter-clockwise from the right neighbour. The indices
/// of opposite steps differ by 4.
inline constexpr std::array<CellStep, 8> cell_steps{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

/// Cells of a map where a round robot may stand, and allowed steps between them.
///
/// If the map has a border, the cells are those of Scene::grid(). Otherwise a margin of cells is
/// added on each side. The outermost cells are then free, so that a robot can go around everything.
struct FreeSpace {
    /// @param radius  radius of the robot [m], >= 0
    FreeSpace(const Scene& scene, Meters radius);

    int margin;         ///< number of cells that are added on each side of the grid
    int columns, rows;  ///< numbers of columns and rows, with the margin
    /// Centre of a cell, given by its index, in cells of the grid without the margin.
    CellPoint centre(int cell) const {
        return {cell % columns - margin + 0.5, cell / columns - margin + 0.5};
    }
    /// Flag of each cell, row by row from the bottom: 1 (free) if the distance of the cell's centre
    /// to every obstacle is at least the robot's radius, otherwise 0.
    std::vector<std::uint8_t> free;
    /// Bits of the allowed steps from each cell, row by row from the bottom. Bit d is set if the
    /// robot may move straight to the centre of the neighbour at cell_steps[d]. A diagonal step
    /// requires that both cells beside it are free, so that no corner is cut.
    std::vector<std::uint8_t> steps;
    /// Number of the connected component of each cell, row by row from the bottom: cells connected
    /// by steps share a number. -1 if the cell is not free.
    std::vector<std::int32_t> part;
};

}  // namespace rovernet
