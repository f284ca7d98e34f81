// SPDX-License-Identifier: MIT
#include "mobility/free_space.hpp"

#include "scene/rectangles.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>

namespace rovernet {
namespace {

/// Half of the tolerance of Scene::passable [m], so that every step found here is passable there.
constexpr double slack = 0.5e-9;

/// Number of cells to add on each side of the grid, see FreeSpace. It is limited to the size of the
/// grid: a robot larger than all walls together finds only straight paths.
int margin_of(const Scene& scene, Meters radius) {
    const OccupancyGrid& grid = scene.grid();
    if (scene.open_field() || scene.has_border()) return 0;
    const double needed = radius.value / std::min(grid.cell_width, grid.cell_height) + 2;
    constexpr int enough = 1000;
    return static_cast<int>(std::min(needed, std::max({grid.columns, grid.rows, enough}) + 0.0));
}

CellRectangle shifted(CellRectangle r, int cells) {
    return {r.column0 + cells, r.row0 + cells, r.column1 + cells, r.row1 + cells};
}

/// Squared distance along one axis [m^2] between a rectangle's side and the centre of the cell
/// `beyond` cells outside it; 0 within the rectangle's rows or columns.
double squared_gap(int beyond, double side) {
    const double gap = std::max(0.0, beyond - 0.5) * side;
    return gap * gap;
}

/// Cells near a rectangle whose centres are nearer to it than `reach` [m], row by row.
///
/// They depend only on the row's distance from the rectangle, so all rectangles share them.
class Surroundings {
  public:
    Surroundings(const OccupancyGrid& grid, double reach) {
        const auto cells = [&](double side, int most) {
            return static_cast<int>(std::min(reach / side, most + 0.0)) + 1;
        };
        int columns = cells(grid.cell_width, grid.columns);
        for (int row = 0; row <= cells(grid.cell_height, grid.rows); ++row) {
            const double up = squared_gap(row, grid.cell_height);
            const auto too_near = [&](int column) {
                const double squared = squared_gap(column, grid.cell_width) + up;
                return !(squared > 0 && squared >= reach * reach);
            };
            while (columns >= 0 && !too_near(columns)) --columns;
            if (columns < 0) break;
            columns_.push_back(columns);
        }
    }

    /// Number of rows above and below the rectangle that have such cells.
    int rows() const { return static_cast<int>(columns_.size()) - 1; }
    /// Number of columns on each side with such cells, in the row `beyond` rows from the rectangle.
    int columns(int beyond) const { return columns_[static_cast<std::size_t>(beyond)]; }

  private:
    std::vector<int> columns_;  // by `beyond`; never none: a rectangle's own cells are too near
};

/// Marks as not free the cells whose centre is inside a rectangle or in the margin around it.
void take_away(std::vector<std::uint8_t>& free, const OccupancyGrid& grid, const CellRectangle& r,
               const Surroundings& around) {
    const int top = std::min(r.row1 + around.rows(), grid.rows);
    for (int row = std::max(r.row0 - around.rows(), 0); row < top; ++row) {
        const int aside = around.columns(std::max({0, r.row0 - row, row + 1 - r.row1}));
        const int left = std::max(r.column0 - aside, 0);
        const int right = std::min(r.column1 + aside, grid.columns);
        const auto cells = free.begin() + std::ptrdiff_t{row} * grid.columns;
        std::fill(cells + left, cells + right, std::uint8_t{0});
    }
}

/// Steps from each cell to its free neighbours.
std::vector<std::uint8_t> steps_between(const std::vector<std::uint8_t>& free,
                                        const OccupancyGrid& grid) {
    const auto columns = static_cast<std::size_t>(grid.columns);
    const auto rows = static_cast<std::size_t>(grid.rows);
    const std::size_t stride = columns + 2;
    // All bits of a byte are set for a free cell; a border of cells around them is not free.
    std::vector<std::uint8_t> bits(stride * (rows + 2), 0);
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t i = 0; i < columns; ++i)
            bits[(row + 1) * stride + i + 1] = free[row * columns + i] ? 0xff : 0;
    std::vector<std::uint8_t> steps(free.size());
    for (std::size_t row = 0; row < rows; ++row) {
        const std::uint8_t* const here = bits.data() + (row + 1) * stride + 1;
        const std::uint8_t *const above = here + stride, *const below = here - stride;
        std::uint8_t* const out = steps.data() + row * columns;
        // As seen from a rectangle of whole cells, the nearest point of the square between four
        // centres is one of the centres. So if the four are free, every path inside the square is
        // passable.
        for (std::ptrdiff_t i = 0; i < grid.columns; ++i) {
            const int east = here[i + 1], north = above[i], west = here[i - 1], south = below[i];
            out[i] = static_cast<std::uint8_t>(
                here[i] & ((east & 0x01) | (east & north & above[i + 1] & 0x02) | (north & 0x04) |
                           (north & west & above[i - 1] & 0x08) | (west & 0x10) |
                           (west & south & below[i - 1] & 0x20) | (south & 0x40) |
                           (south & east & below[i + 1] & 0x80)));
        }
    }
    return steps;
}

/// Run of consecutive free cells in one row.
struct FreeRun {
    std::size_t begin, end;  // cells
    std::size_t first;       // the run of the same part that was found first, as far as known
};

/// Free cells as runs, in order; touching runs of neighbouring rows are joined to components.
///
/// Diagonal steps join no components that straight steps do not.
class FreeRuns {
  public:
    FreeRuns(const std::vector<std::uint8_t>& free, std::size_t columns) {
        std::size_t below = 0, row_begin = 0;  // first runs of the row below and of the row
        for (std::size_t row = 0; row < free.size(); row += columns) {
            add_row(free, row, row + columns);
            join_rows(below, row_begin, columns);
            below = std::exchange(row_begin, runs_.size());
        }
    }

    /// Numbers the components in the order of their first cells.
    void number_parts(std::vector<std::int32_t>& part) const {
        std::vector<std::int32_t> numbers(runs_.size());
        std::int32_t next = 0;
        for (std::size_t i = 0; i < runs_.size(); ++i) {
            const FreeRun& run = runs_[i];
            numbers[i] = run.first == i ? next++ : numbers[run.first];
            const auto cells = part.begin();
            std::fill(cells + static_cast<std::ptrdiff_t>(run.begin),
                      cells + static_cast<std::ptrdiff_t>(run.end), numbers[i]);
        }
    }

  private:
    void add_row(const std::vector<std::uint8_t>& free, std::size_t cell, std::size_t end) {
        const auto find = [&](std::uint8_t what) {
            const void* found = std::memchr(free.data() + cell, what, end - cell);
            cell = found ? static_cast<std::size_t>(static_cast<const std::uint8_t*>(found) -
                                                    free.data())
                         : end;
            return cell;
        };
        while (find(1) < end) {
            const std::size_t begin = cell;
            runs_.push_back({begin, find(0), runs_.size()});
        }
    }

    /// Joins the runs from `row` on with the runs of the row below, which start at `below`.
    void join_rows(std::size_t below, std::size_t row, std::size_t columns) {
        for (std::size_t low = below, high = row; low < row && high < runs_.size();) {
            const std::size_t begin = runs_[low].begin + columns, end = runs_[low].end + columns;
            if (begin < runs_[high].end && runs_[high].begin < end) join(low, high);
            end < runs_[high].end ? ++low : ++high;
        }
    }

    std::size_t root(std::size_t run) {
        while (runs_[run].first != run) {
            run = runs_[run].first = runs_[runs_[run].first].first;
        }
        return run;
    }
    void join(std::size_t a, std::size_t b) {
        const auto [first, later] = std::minmax({root(a), root(b)});
        runs_[later].first = first;
    }

    std::vector<FreeRun> runs_;
};

}  // namespace

FreeSpace::FreeSpace(const Scene& scene, Meters radius)
    : margin(margin_of(scene, radius)),
      columns(scene.grid().columns + 2 * margin),
      rows(scene.grid().rows + 2 * margin) {
    const OccupancyGrid grid{.columns = columns,
                             .rows = rows,
                             .cell_width = scene.grid().cell_width,
                             .cell_height = scene.grid().cell_height,
                             .cells = {}};
    free.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 1);
    part.assign(free.size(), -1);
    const Surroundings surroundings(grid, std::max(radius.value - slack, 0.0));
    for (const CellRectangle& r : scene.obstacles()) {
        take_away(free, grid, shifted(r, margin), surroundings);
    }
    steps = steps_between(free, grid);
    if (!free.empty()) {
        FreeRuns(free, static_cast<std::size_t>(grid.columns)).number_parts(part);
    }
}

}  // namespace rovernet
