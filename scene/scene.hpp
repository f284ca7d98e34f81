// SPDX-License-Identifier: MIT
#pragma once

#include "scene/map_frame.hpp"
#include "scene/occupancy.hpp"
#include "scene/rectangles.hpp"
#include "scene/wall_index.hpp"
#include "sim/geometry.hpp"
#include "sim/units.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace rovernet {

/// The world's walls: one map that radio, motion and pictures read. Never changes once built.
///
/// A default Scene is an open field: no walls, no end. Walls are the union of the occupied cells,
/// infinitely high. A segment along the common edge of two occupied cells is inside the wall, along
/// an outer edge it is outside; touching a corner or an edge counts nothing; wall against wall is
/// one crossing. Unknown cells are no walls for radio, but obstacles for robots; beyond the map
/// there is nothing. Coordinates and lengths within 1e-9 of a cell are equal: a point that near to
/// a grid line lies on it, a gap that short is closed, a crossing that short is none.
class Scene {
  public:
    Scene() = default;
    /// @throws std::invalid_argument if the grid's sizes, cells or placement make no sense
    explicit Scene(OccupancyGrid grid);

    /// There is no map.
    bool open_field() const { return grid_.columns == 0; }

    /// Walls between two points: x and y decide, lengths [m] are along the 3-D segment from a.
    ///
    /// From b to a the crossings come in the opposite order with the same `length`, to the last
    /// bit. A segment straight up inside a wall is one crossing.
    /// @param out  emptied first
    void crossings(Vec3 a, Vec3 b, std::vector<Crossing>& out) const;
    std::vector<Crossing> crossings(Vec3 a, Vec3 b) const;

    /// Total length inside walls [m]; the same bits from a to b as from b to a.
    double wall_length(Vec3 a, Vec3 b) const {
        return wall_length(a, b, std::numeric_limits<double>::infinity());
    }
    /// As above, but may stop counting once the total exceeds `enough` [m]: a result above `enough`
    /// says only that, any other is exact.
    double wall_length(Vec3 a, Vec3 b, double enough) const;

    /// The point lies in an occupied cell; left and lower edges belong to a cell, others do not.
    bool occupied(Vec3 p) const;
    /// The point lies on the map, edges included; everywhere on an open field.
    bool inside_map(Vec3 p) const;
    /// Distance to the nearest obstacle [m]: 0 inside or touching, infinity if there is none.
    double clearance(Vec3 p) const;
    /// A disc of that radius [m] can move straight from a to b; touching an obstacle is allowed.
    ///
    /// Exact: the distance from the segment to each obstacle, less 1e-9 m, against the radius.
    bool passable(Vec3 a, Vec3 b, Meters radius) const;

    /// Corners of the smallest upright box around the map [m]; both (0, 0) on an open field.
    Vec3 lower_left() const { return lower_left_; }
    Vec3 upper_right() const { return upper_right_; }
    /// The walls as disjoint rectangles, each by its corners [m], counter-clockwise.
    std::vector<std::array<Vec3, 4>> wall_rectangles() const;
    /// Where robots must not go, in cells.
    const std::vector<CellRectangle>& obstacles() const { return obstacles_; }
    std::size_t occupied_cells() const { return occupied_cells_; }
    const OccupancyGrid& grid() const { return grid_; }
    const MapFrame& frame() const { return frame_; }

  private:
    const WallIndex& obstacle_index() const { return obstacle_index_ ? *obstacle_index_ : walls_; }

    OccupancyGrid grid_;
    MapFrame frame_;
    WallIndex walls_;
    std::optional<WallIndex> obstacle_index_;  ///< only if some cell is unknown
    std::vector<CellRectangle> obstacles_;
    std::size_t occupied_cells_ = 0;
    Vec3 lower_left_{};
    Vec3 upper_right_{};
};

}  // namespace rovernet
