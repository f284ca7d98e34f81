// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

// Simple methods for the length of a link inside walls, as used by other simulators. They are only
// compared with Scene.

namespace rovernet {

/// Raster of walls with square cells parallel to the axes.
class NaiveRaster {
  public:
    /// @param cell     size of a cell [m]
    /// @param is_wall  whether a point is in a wall; called for the centre of each cell
    NaiveRaster(Vec3 low, Vec3 high, double cell, const std::function<bool(Vec3)>& is_wall);

    /// Length [m] of the line a-b inside wall cells, by traversal of cells along the line (digital
    /// differential analyser). Source: J. Amanatides and A. Woo, A fast voxel traversal algorithm,
    /// 1987.
    double traversed(Vec3 a, Vec3 b) const;
    /// Length [m] of the line a-b inside walls, estimated as the length of a-b times the share of
    /// wall cells among the cells of its Bresenham line. Source: J. E. Bresenham, IBM Systems
    /// Journal 4(1), 1965.
    double bresenham(Vec3 a, Vec3 b) const;

  private:
    bool wall(std::int64_t column, std::int64_t row) const {
        if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return false;
        return cells_[static_cast<std::size_t>(row * columns_ + column)] != 0;
    }
    Vec3 in_cells(Vec3 p) const { return {(p.x - low_.x) / cell_, (p.y - low_.y) / cell_}; }

    Vec3 low_;
    double cell_;  // edge length of a cell [m]
    std::int64_t columns_, rows_;
    std::vector<std::uint8_t> cells_;
};

/// Length [m] of the line a-b inside walls, estimated from samples at about every `step` [m].
/// @param is_wall  whether a point is in a wall; called for each sample
template <class IsWall>
double sampled_wall(Vec3 a, Vec3 b, double step, const IsWall& is_wall) {
    const double length = distance(a, b);
    const auto n = static_cast<std::size_t>(length / step) + 1;
    std::size_t inside = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
        inside += is_wall(a + share * (b - a));
    }
    return length * static_cast<double>(inside) / static_cast<double>(n);
}

}  // namespace rovernet
