// SPDX-License-Identifier: MIT
#include "scene/rectangles.hpp"

#include <cstddef>

namespace rovernet {
namespace {

/// The cells still to be covered.
class Uncovered {
  public:
    /// @param is_solid  of a cell, by its index
    template <class IsSolid>
    Uncovered(const OccupancyGrid& grid, IsSolid is_solid)
        : columns_(grid.columns), rows_(grid.rows), left_(grid.cells.size()) {
        for (std::size_t i = 0; i < left_.size(); ++i) left_[i] = is_solid(i);
    }

    bool at(int column, int row) const { return left_[index(column, row)]; }

    CellRectangle largest_from(int column, int row) const {
        CellRectangle wide{column, row, column + 1, row + 1};
        while (grow_right(wide)) {
        }
        while (grow_up(wide)) {
        }
        CellRectangle tall{column, row, column + 1, row + 1};
        while (grow_up(tall)) {
        }
        while (grow_right(tall)) {
        }
        return area(tall) > area(wide) ? tall : wide;
    }

    void cover(const CellRectangle& r) {
        for (int row = r.row0; row < r.row1; ++row)
            for (int column = r.column0; column < r.column1; ++column)
                left_[index(column, row)] = false;
    }

  private:
    std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(column);
    }
    static std::int64_t area(const CellRectangle& r) {
        return std::int64_t{r.column1 - r.column0} * (r.row1 - r.row0);
    }
    bool grow_right(CellRectangle& r) const {
        if (r.column1 == columns_) return false;
        for (int row = r.row0; row < r.row1; ++row)
            if (!at(r.column1, row)) return false;
        ++r.column1;
        return true;
    }
    bool grow_up(CellRectangle& r) const {
        if (r.row1 == rows_) return false;
        for (int column = r.column0; column < r.column1; ++column)
            if (!at(column, r.row1)) return false;
        ++r.row1;
        return true;
    }

    int columns_;
    int rows_;
    std::vector<bool> left_;
};

std::vector<CellRectangle> cover(const OccupancyGrid& grid, Uncovered uncovered) {
    std::vector<CellRectangle> rectangles;
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column)
            if (uncovered.at(column, row)) {
                rectangles.push_back(uncovered.largest_from(column, row));
                uncovered.cover(rectangles.back());
            }
    return rectangles;
}

}  // namespace

std::vector<CellRectangle> solid_rectangles(const OccupancyGrid& grid, Solid solid) {
    return cover(grid, Uncovered(grid, [&](std::size_t i) {
                     return grid.cells[i] == Cell::occupied ||
                            (solid == Solid::obstacles && grid.cells[i] == Cell::unknown);
                 }));
}

std::vector<CellRectangle> solid_rectangles(const OccupancyGrid& grid, WallsOf walls) {
    return cover(grid, Uncovered(grid, [&](std::size_t i) {
                     return grid.cells[i] == Cell::occupied &&
                            grid.material_of(i) == walls.material;
                 }));
}

}  // namespace rovernet
