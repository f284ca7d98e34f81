// SPDX-License-Identifier: MIT
#pragma once

#include "scene/occupancy.hpp"
#include "sim/math.hpp"

#include <cmath>
#include <cstddef>

namespace rovernet {

/// Point on the map in units of cells: u along the rows, v along the columns; cell (0, 0) is [0,1)
/// x [0,1).
struct CellPoint {
    double u = 0;
    double v = 0;
    friend constexpr bool operator==(CellPoint, CellPoint) = default;
};

/// Tolerance of coordinates and lengths [cells]. A coordinate nearer than this to a grid line lies
/// on the line. A length shorter than this counts as 0.
inline constexpr double cell_tolerance = 1e-9;

/// Placement of a map in the world: converts metres to cells and back.
class MapFrame {
  public:
    MapFrame() = default;
    explicit MapFrame(const OccupancyGrid& grid)
        : origin_(grid.origin),
          cell_width_(grid.cell_width),
          cell_height_(grid.cell_height),
          yaw_(grid.yaw) {
        const auto [sine, cosine] = math::sincos(grid.yaw);
        sine_ = sine;
        cosine_ = cosine;
    }

    /// Point of the map, in units of cells, for a point in the world [m]. A coordinate within
    /// cell_tolerance of a grid line is moved onto the line, so that a coordinate such as 0.15 m
    /// with cells of 0.05 m is exactly 3 cells.
    CellPoint to_cells(Vec3 p) const {
        const double x = p.x - origin_.x;
        const double y = p.y - origin_.y;
        return {snap((cosine_ * x + sine_ * y) / cell_width_),
                snap((cosine_ * y - sine_ * x) / cell_height_)};
    }
    /// Point in the world [m], at height z [m], for a point of the map in units of cells.
    Vec3 to_world(CellPoint p, double z = 0) const {
        const double x = p.u * cell_width_;
        const double y = p.v * cell_height_;
        return {origin_.x + (cosine_ * x - sine_ * y), origin_.y + (sine_ * x + cosine_ * y), z};
    }
    double floor() const { return origin_.z; }  ///< height of the map's floor [m]
    double yaw() const { return yaw_; }  ///< direction of the map's rows [rad], counter-clockwise
    double cell_width() const { return cell_width_; }    ///< width of a cell [m]
    double cell_height() const { return cell_height_; }  ///< height of a cell [m]
    /// Map with this placement and the given number of columns and rows; all its cells are free.
    OccupancyGrid map(int columns, int rows) const;

  private:
    static double snap(double cells) {
        const double line = std::floor(cells + 0.5);
        return std::abs(cells - line) <= cell_tolerance ? line : cells;
    }

    Vec3 origin_{};
    double cosine_ = 1;
    double sine_ = 0;
    double cell_width_ = 1;
    double cell_height_ = 1;
    double yaw_ = 0;
};

inline OccupancyGrid MapFrame::map(int columns, int rows) const {
    OccupancyGrid map;
    map.columns = columns;
    map.rows = rows;
    map.cell_width = cell_width_;
    map.cell_height = cell_height_;
    map.origin = origin_;
    map.yaw = yaw_;
    const auto cells = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    map.cells.assign(cells, Cell::free);
    return map;
}

}  // namespace rovernet
