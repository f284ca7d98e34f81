// SPDX-License-Identifier: MIT
#include "scene/free_space.hpp"

#include <algorithm>
#include <cstddef>

namespace rovernet {
namespace {

/// Half of what Scene::passable allows [m], so that every step found here is passable there.
constexpr double touching = 0.5e-9;

/// Squared distance along one axis from a cell's centre to the cells low to high - 1 [m^2].
double squared_gap(int cell, int low, int high, double side) {
    const double gap = std::max({0.0, low - (cell + 0.5), cell + 0.5 - high}) * side;
    return gap * gap;
}

/// Marks the cells whose centre is inside a rectangle or nearer to it than `reach` [m].
void take_away(std::vector<std::uint8_t>& free, const OccupancyGrid& grid, const CellRectangle& r,
               double reach) {
    const auto cells = [&](double side, int most) {
        return static_cast<int>(std::min(reach / side, most + 0.0)) + 1;
    };
    const int aside = cells(grid.cell_width, grid.columns);
    const int above = cells(grid.cell_height, grid.rows);
    const int left = std::max(r.column0 - aside, 0);
    const int right = std::min(r.column1 + aside, grid.columns);
    const int top = std::min(r.row1 + above, grid.rows);
    std::vector<double> across;
    for (int column = left; column < right; ++column)
        across.push_back(squared_gap(column, r.column0, r.column1, grid.cell_width));
    for (int row = std::max(r.row0 - above, 0); row < top; ++row) {
        const double up = squared_gap(row, r.row0, r.row1, grid.cell_height);
        std::uint8_t* cell = free.data() + std::ptrdiff_t{row} * grid.columns + left;
        for (const double gap : across) {
            const double squared = gap + up;
            *cell++ &= squared > 0 && squared >= reach * reach;
        }
    }
}

/// Fills space.part, one part after the other, from its first cell on.
void number_parts(FreeSpace& space, int columns) {
    std::int32_t number = 0;
    std::vector<std::size_t> open;
    for (std::size_t first = 0; first < space.free.size(); ++first) {
        if (!space.free[first] || space.part[first] >= 0) continue;
        space.part[first] = number;
        open.assign(1, first);
        while (!open.empty()) {
            const std::size_t cell = open.back();
            open.pop_back();
            for (std::size_t d = 0; d < cell_steps.size(); ++d) {
                if (!(space.steps[cell] >> d & 1)) continue;
                const std::size_t next =
                    cell + static_cast<std::size_t>(
                               std::ptrdiff_t{cell_steps[d].row * columns + cell_steps[d].column});
                if (space.part[next] >= 0) continue;
                space.part[next] = number;
                open.push_back(next);
            }
        }
        ++number;
    }
}

}  // namespace

FreeSpace::FreeSpace(const Scene& scene, Meters radius)
    : free(scene.grid().cells.size(), 1),
      steps(scene.grid().cells.size(), 0),
      part(scene.grid().cells.size(), -1) {
    const OccupancyGrid& grid = scene.grid();
    const double reach = std::max(radius.value - touching, 0.0);
    for (const CellRectangle& r : scene.obstacles()) take_away(free, grid, r, reach);

    const auto index = [&](int column, int row) {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
               static_cast<std::size_t>(column);
    };
    const auto is_free = [&](int column, int row) {
        return column >= 0 && column < grid.columns && row >= 0 && row < grid.rows &&
               free[index(column, row)];
    };
    // Seen from a rectangle of whole cells, the nearest point of the square between four centres is
    // one of the centres. So where they are free, every way inside the square is passable.
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column)
            for (std::size_t d = 0; d < cell_steps.size() && is_free(column, row); ++d) {
                const int i = column + cell_steps[d].column, j = row + cell_steps[d].row;
                if (is_free(i, j) && is_free(column, j) && is_free(i, row))
                    steps[index(column, row)] |= static_cast<std::uint8_t>(1 << d);
            }
    number_parts(*this, grid.columns);
}

}  // namespace rovernet
