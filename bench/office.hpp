// SPDX-License-Identifier: MIT
#pragma once

#include "scene/occupancy.hpp"
#include "sim/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rovernet::bench {

/// Map of an office of 40 m x 20 m in cells of 5 cm: four rows of eight rooms, each 5 m wide, along
/// two corridors of 2 m; walls of 10 cm. Every room has a door to its corridor. Rooms in the two
/// middle rows also have a door to the opposite room.
class Office {
  public:
    Office() {
        grid_.columns = cells(width);
        grid_.rows = cells(depth);
        grid_.cell_width = grid_.cell_height = cell;
        grid_.cells.assign(
            static_cast<std::size_t>(grid_.columns) * static_cast<std::size_t>(grid_.rows),
            Cell::free);
        for (const double y : {0.0, 5.0, 7.0, 10.0, 13.0, 15.0, depth - wall}) {
            fill({0, y}, {width, y + wall}, Cell::occupied);
        }
        for (const double x : {0.0, width - wall}) {
            fill({x, 0}, {x + wall, depth}, Cell::occupied);
        }
        for (int i = 1; i < rooms; ++i) {
            const double x = room * i;
            fill({x, 0}, {x + wall, 5}, Cell::occupied);
            fill({x, 7}, {x + wall, 13}, Cell::occupied);
            fill({x, 15}, {x + wall, depth}, Cell::occupied);
        }
        for (int i = 0; i < rooms; ++i) {
            int row = 0;
            for (const double y : {5.0, 7.0, 10.0, 13.0, 15.0}) {
                const double x = room * i + 0.5 + 0.75 * row++;
                fill({x, y}, {x + door, y + wall}, Cell::free);
            }
        }
    }
    const OccupancyGrid& grid() const { return grid_; }

    static constexpr double width = 40, depth = 20;  // size of the floor [m]

  private:
    static constexpr double cell = 0.05, wall = 0.1, door = 1, room = 5;  // [m]
    static constexpr int rooms = 8;

    static int cells(double length) { return static_cast<int>(std::round(length / cell)); }
    void fill(Vec3 low, Vec3 high, Cell what) {
        for (int row = cells(low.y); row < cells(high.y); ++row) {
            const auto first = grid_.cells.begin() + std::ptrdiff_t{row} * grid_.columns;
            std::fill(first + cells(low.x), first + cells(high.x), what);
        }
    }

    OccupancyGrid grid_;
};

}  // namespace rovernet::bench
