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

/// Thickness of the walls of one layer, as they are drawn.
///
/// The thickness at a cell is its shortest chord through solid cells along the rows, the columns
/// and the two diagonals of the map. It exceeds that of a straight wall at any angle by at most 8 %
/// (1 / cos 22.5 degrees, square cells) and the steps of its outline. The inside of a wall drawn as
/// an outline counts. A table with 4 bytes for each cell is made at the first question; questions
/// may come from several threads.
class WallThickness {
  public:
    /// @param walls    not null
    /// @param hollows  of the map; not null
    WallThickness(const MapFrame& frame, std::shared_ptr<const WallIndex> walls,
                  std::shared_ptr<const HollowWalls> hollows);

    /// [m] At the cell that holds the point; 0 where there is no wall.
    double at(CellPoint p) const {
        const int columns = walls_->columns();
        if (!(p.u >= 0 && p.v >= 0 && p.u < columns && p.v < walls_->rows())) return 0;
        measured_([this] { measure(); });
        const auto column = static_cast<std::size_t>(p.u), row = static_cast<std::size_t>(p.v);
        return thickness_[row * static_cast<std::size_t>(columns) + column];
    }

  private:
    void measure() const;

    double cell_width_, cell_height_;  // [m]
    std::shared_ptr<const WallIndex> walls_;
    std::shared_ptr<const HollowWalls> hollows_;
    mutable Once measured_;
    mutable std::vector<float> thickness_;  // [m] by cell
};

}  // namespace rovernet
