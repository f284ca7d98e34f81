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

/// Solid and free cells of a map, row by row.
struct CellMap {
    int columns, rows;
    double cell;              ///< longer side of a cell [m]
    std::vector<bool> solid;  ///< true for solid cells; columns * rows

    bool is_solid(int column, int row) const {
        return solid[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                     static_cast<std::size_t>(column)];
    }
};

/// Calls visit(cells) for each free area that is enclosed by walls and nowhere wider than `widest`,
/// to within a cell. Cells of an area are connected by their sides; walls that touch only at a
/// corner also enclose.
void for_each_hollow(const CellMap& map, Meters widest,
                     const std::function<void(std::span<const std::size_t> cells)>& visit);

/// Interiors of walls that a map draws as outlines: enclosed areas so narrow that the wall is at
/// most half a metre thick, and whose border is mostly a line one or two cells wide.
///
/// A cavity between two walls of three or more cells is not an interior, and neither is a slot open
/// at one end. The interiors are found on first use; several threads may call at once.
class HollowWalls {
  public:
    /// @param walls  walls of all materials on the map; none is null
    HollowWalls(const MapFrame& frame, std::vector<std::shared_ptr<const WallIndex>> walls);

    /// Whether the map has any hollow wall.
    bool any() const { return !cells().empty(); }
    /// Whether the cell is in the interior of a wall.
    bool holds(int column, int row) const;
    bool holds(CellPoint p) const;

  private:
    const std::vector<bool>& cells() const;
    void find() const;

    double cell_;  // longer side of a cell [m]
    std::vector<std::shared_ptr<const WallIndex>> walls_;
    mutable Once found_;
    mutable std::vector<bool> cells_;  // by row and column; empty if there are none
};

}  // namespace rovernet
