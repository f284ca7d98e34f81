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

/// Cells of a map, row by row.
struct CellMap {
    int columns, rows;
    double cell;              ///< side of a cell, the longer one [m]
    std::vector<bool> solid;  ///< columns * rows

    bool is_solid(int column, int row) const {
        return solid[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                     static_cast<std::size_t>(column)];
    }
};

/// Calls visit(cells) for each area that walls enclose and that is nowhere wider than `widest`, to
/// a cell. Cells of an area touch by their sides; walls that touch at a corner enclose.
void for_each_hollow(const CellMap& map, Meters widest,
                     const std::function<void(std::span<const std::size_t> cells)>& visit);

/// Insides of the walls that a map has as outlines: areas that walls enclose, so narrow that the
/// wall is at most half a metre thick, most of whose border is a stroke of one or two cells.
///
/// A cavity between two walls of three cells and more is none, and neither is a slot that is open
/// at an end. They are looked for at the first question; questions may come from several threads.
class HollowWalls {
  public:
    /// @param walls  of all materials on the map; none is null
    HollowWalls(const MapFrame& frame, std::vector<std::shared_ptr<const WallIndex>> walls);

    /// There is one at least.
    bool any() const { return !cells().empty(); }
    /// The cell is the inside of a wall.
    bool holds(int column, int row) const;
    bool holds(CellPoint p) const;

  private:
    const std::vector<bool>& cells() const;
    void find() const;

    double cell_;  // side, the longer one [m]
    std::vector<std::shared_ptr<const WallIndex>> walls_;
    mutable Once found_;
    mutable std::vector<bool> cells_;  // by row and column; empty if there are none
};

}  // namespace rovernet
