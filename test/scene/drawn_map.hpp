// SPDX-License-Identifier: MIT
#pragma once

#include "scene/occupancy.hpp"

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace rovernet::test {

/// Map drawn as text: top row first, '#' occupied, '?' unknown, any other character free. Cells
/// have the size `cell` [m].
inline OccupancyGrid drawn_map(const std::vector<std::string>& rows, double cell = 1) {
    OccupancyGrid grid;
    grid.columns = static_cast<int>(rows.front().size());
    grid.rows = static_cast<int>(rows.size());
    grid.cell_width = grid.cell_height = cell;
    for (auto row = rows.rbegin(); row != rows.rend(); ++row)
        for (const char c : *row)
            grid.cells.push_back(c == '#' ? Cell::occupied : c == '?' ? Cell::unknown : Cell::free);
    return grid;
}

/// Generator of random numbers that are equal on all machines.
class Draw {
  public:
    explicit Draw(std::uint32_t seed) : bits_(seed) {}
    double uniform(double low, double high) { return low + (high - low) * (bits() / 4294967296.0); }
    int below(int n) { return static_cast<int>(bits() % static_cast<std::uint32_t>(n)); }

  private:
    std::uint32_t bits() { return static_cast<std::uint32_t>(bits_()); }
    std::mt19937 bits_;
};

/// Map with `percent` % of its cells occupied at random, and some long walls.
inline OccupancyGrid random_map(Draw& draw, int columns, int rows, int percent) {
    OccupancyGrid grid;
    grid.columns = columns;
    grid.rows = rows;
    const auto cells = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    for (std::size_t i = 0; i < cells; ++i)
        grid.cells.push_back(draw.below(100) < percent ? Cell::occupied : Cell::free);
    const auto occupy = [&](int column, int row) {
        grid.cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(column)] = Cell::occupied;
    };
    for (int wall = 0; wall < 3; ++wall) {
        const int column = draw.below(columns), row = draw.below(rows);
        for (int i = draw.below(columns); i < columns; ++i) occupy(i, row);
        for (int j = draw.below(rows); j < rows; ++j) occupy(column, j);
    }
    return grid;
}

}  // namespace rovernet::test
