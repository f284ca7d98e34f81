// SPDX-License-Identifier: MIT
#pragma once

#include "scene/hollow_walls.hpp"
#include "scene/map_frame.hpp"
#include "scene/once.hpp"
#include "scene/wall_index.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace rovernet {

/// Thickness of the walls of one material on one map. The interior of a wall that is drawn as an
/// outline is included.
///
/// The thickness at a cell is the length of the shortest straight line through the wall (chord)
/// along rows, columns or diagonals of the map. For an oblique wall it is the mean length of
/// neighbouring chords whose lengths differ by at most one cell, times the sine of their angle to
/// the wall. So the steps of the outline have no effect. A table with 4 bytes per cell is made on
/// first use (temporarily 12 more). Several threads may call the functions concurrently.
class WallThickness {
  public:
    /// @param walls    spatial index of the walls; not null
    /// @param hollows  hollow walls of the map; not null
    WallThickness(const MapFrame& frame, std::shared_ptr<const WallIndex> walls,
                  std::shared_ptr<const HollowWalls> hollows);

    /// Thickness [m] at the cell that contains the point; 0 outside walls.
    double at(CellPoint p) const {
        const int columns = walls_->columns();
        if (!(p.u >= 0 && p.v >= 0 && p.u < columns && p.v < walls_->rows())) return 0;
        measured_([this] { measure(); });
        const auto column = static_cast<std::size_t>(p.u), row = static_cast<std::size_t>(p.v);
        return thickness_[row * static_cast<std::size_t>(columns) + column];
    }

  private:
    void measure() const;

    double cell_width_, cell_height_;  // size of a map cell [m]
    std::shared_ptr<const WallIndex> walls_;
    std::shared_ptr<const HollowWalls> hollows_;
    mutable Once measured_;
    mutable std::vector<float> thickness_;  // wall thickness at each map cell [m]
};

}  // namespace rovernet
