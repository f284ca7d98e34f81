// SPDX-License-Identifier: MIT
#pragma once

#include "scene/map_frame.hpp"
#include "scene/once.hpp"
#include "scene/wall_index.hpp"
#include "sim/units.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace rovernet {

/// Map of solid (wall) and free cells.
struct CellMap {
    int columns, rows;
    double cell;              ///< longer side of a cell [m]
    std::vector<bool> solid;  ///< true for solid cells, row by row; columns * rows elements

    bool is_solid(int column, int row) const {
        return solid[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                     static_cast<std::size_t>(column)];
    }
};

/// Calls visit(cells) for each free area that walls enclose and that is nowhere wider than `widest`
/// [m], to within a cell. `cells` are the indices of the area's cells. Cells of an area are
/// connected by their sides. Walls that touch only at a corner also enclose an area.
void for_each_hollow(const CellMap& map, Meters widest,
                     const std::function<void(std::span<const std::size_t> cells)>& visit);

/// Interiors of walls that a map draws as outlines (hollow walls). An interior is an enclosed free
/// area so narrow that the wall is at most 0.5 m thick. Most of the drawn outline around it is one
/// or two cells thick. A cavity between two walls that are drawn three or more cells thick is not
/// an interior, nor is a slot that is open at one end.
///
/// The interiors are found on first use. Several threads may call the functions concurrently.
class HollowWalls {
  public:
    /// @param walls  walls of all materials on the map; none is null
    HollowWalls(const MapFrame& frame, std::vector<std::shared_ptr<const WallIndex>> walls);

    /// Whether the map has any hollow wall.
    bool any() const { return !cells().empty(); }
    /// Whether the cell is in the interior of a hollow wall.
    bool holds(int column, int row) const;
    bool holds(CellPoint p) const;

  private:
    const std::vector<bool>& cells() const;
    void find() const;

    double cell_;  // longer side of a cell [m]
    std::vector<std::shared_ptr<const WallIndex>> walls_;
    mutable Once found_;
    mutable std::vector<bool> cells_;  // true for cells in interiors, row by row; empty: no cell is
};

}  // namespace rovernet
