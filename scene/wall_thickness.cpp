// SPDX-License-Identifier: MIT
#include "scene/wall_thickness.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace rovernet {

WallThickness::WallThickness(const MapFrame& frame, std::shared_ptr<const WallIndex> walls,
                             std::shared_ptr<const HollowWalls> hollows)
    : cell_width_(frame.cell_width()),
      cell_height_(frame.cell_height()),
      walls_(std::move(walls)),
      hollows_(std::move(hollows)) {}

/// Walks every line of cells in each of four directions; a run of cells of the wall is as thick
/// as it is long.
void WallThickness::measure() const {
    const int columns = walls_->columns(), rows = walls_->rows();
    const auto number = [&](int column, int row) {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(column);
    };
    thickness_.assign(number(0, rows), 0);
    const auto walk = [&](int column, int row, int right, int up, double step) {
        std::vector<std::size_t> run;
        const auto end_run = [&] {
            const auto length = static_cast<float>(static_cast<double>(run.size()) * step);
            for (const std::size_t cell : run) {
                float& least = thickness_[cell];
                least = least > 0 ? std::min(least, length) : length;
            }
            run.clear();
        };
        for (; column >= 0 && column < columns && row < rows; column += right, row += up) {
            if (walls_->solid(column, row) || hollows_->holds(column, row)) {
                run.push_back(number(column, row));
            } else {
                end_run();
            }
        }
        end_run();
    };
    const double diagonal = std::sqrt(cell_width_ * cell_width_ + cell_height_ * cell_height_);
    for (int row = 0; row < rows; ++row) {
        walk(0, row, 1, 0, cell_width_);
        if (row > 0) walk(0, row, 1, 1, diagonal);
        if (row > 0) walk(columns - 1, row, -1, 1, diagonal);
    }
    for (int column = 0; column < columns; ++column) {
        walk(column, 0, 0, 1, cell_height_);
        walk(column, 0, 1, 1, diagonal);
        walk(column, 0, -1, 1, diagonal);
    }
}

}  // namespace rovernet
