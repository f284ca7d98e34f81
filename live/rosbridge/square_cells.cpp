// SPDX-License-Identifier: MIT
#include "live/rosbridge/square_cells.hpp"

#include "scene/images/image.hpp"

#include <algorithm>
#include <cmath>

namespace rovernet {
namespace {

constexpr double same = 1e-6;  // distance of grid lines below which they are equal [cells]

/// Number of cells of a side that cover a length [-], which need not be whole.
double cells_along(double length, double side) {
    const double whole = std::round(length / side);
    return std::abs(length / side - whole) < same ? whole : length / side;
}

/// Side of square cells for a map with cells of different sides [m], see square_cells().
double square_side(const OccupancyGrid& map) {
    const double width = map.columns * map.cell_width, height = map.rows * map.cell_height;
    const double longest = std::max(std::min(map.cell_width, map.cell_height),
                                    std::sqrt(width / max_image_pixels * height));
    const double fewest = std::ceil(cells_along(width, longest));
    for (double columns = fewest; columns <= fewest * 9 / 8; ++columns) {
        const double rows = cells_along(height, width / columns);
        if (rows == std::round(rows) && rows > 0) return width / columns;
    }
    return longest;
}

/// Cells of one side that a cell of another side overlaps: [first, last].
struct Overlap {
    int first, last;
    Overlap(int number, double side, double other, int count)
        : first(std::min(static_cast<int>(number * side / other + same), count - 1)),
          last(std::clamp(static_cast<int>(std::ceil((number + 1) * side / other - same)) - 1,
                          first, count - 1)) {}
};

Cell worst_of(const OccupancyGrid& map, Overlap columns, Overlap rows) {
    Cell worst = Cell::free;
    for (int row = rows.first; row <= rows.last; ++row) {
        for (int column = columns.first; column <= columns.last; ++column) {
            const Cell cell = map.at(column, row);
            if (cell == Cell::occupied) return cell;
            if (cell == Cell::unknown) worst = cell;
        }
    }
    return worst;
}

}  // namespace

OccupancyGrid square_cells(const OccupancyGrid& map) {
    if (std::abs(map.cell_width - map.cell_height) <= 1e-9 * map.cell_width) return map;
    const double side = square_side(map);
    OccupancyGrid out;
    out.columns = static_cast<int>(std::ceil(cells_along(map.columns * map.cell_width, side)));
    out.rows = static_cast<int>(std::ceil(cells_along(map.rows * map.cell_height, side)));
    out.cell_width = out.cell_height = side;
    out.origin = map.origin;
    out.yaw = map.yaw;
    for (int row = 0; row < out.rows; ++row) {
        const Overlap rows(row, side, map.cell_height, map.rows);
        for (int column = 0; column < out.columns; ++column) {
            out.cells.push_back(
                worst_of(map, Overlap(column, side, map.cell_width, map.columns), rows));
        }
    }
    return out;
}

}  // namespace rovernet
