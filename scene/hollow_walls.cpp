// SPDX-License-Identifier: MIT
#include "scene/hollow_walls.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rovernet {
namespace {

constexpr Meters thickest_wall{0.5};
constexpr int widest_stroke = 2;  // [cells]

/// Calls visit(column, row) for the cells on the border of a square around a cell, within the map,
/// until it returns true. @return whether it did
template <class Visit>
bool any_on_rim(const CellMap& map, int column, int row, int steps, Visit visit) {
    const auto ask = [&](int i, int j) {
        return i >= 0 && j >= 0 && i < map.columns && j < map.rows && visit(i, j);
    };
    for (int k = -steps; k <= steps; ++k)
        if (ask(column + k, row - steps) || ask(column + k, row + steps) ||
            ask(column - steps, row + k) || ask(column + steps, row + k))
            return true;
    return false;
}

/// Enumerates the areas of a map that are not solid.
class Areas {
  public:
    Areas(const CellMap& map, Meters widest)
        : map_(map),
          most_steps_(static_cast<int>((widest.value / map.cell + 1) / 2 + 1e-9)),
          seen_(map.solid) {}

    /// Finds the next cell without an area; false if there is none.
    bool next() {
        while (first_ < seen_.size() && seen_[first_]) ++first_;
        return first_ < seen_.size();
    }
    /// Determines the area of that cell, and whether it is enclosed and narrow.
    bool is_hollow() {
        cells_.assign(1, first_);
        seen_[first_] = true;
        bool hollow = true;
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            const int column = static_cast<int>(cells_[i] % columns());
            const int row = static_cast<int>(cells_[i] / columns());
            hollow = hollow && is_inside(column, row) && is_near_wall(column, row);
            add_neighbours(column, row);
        }
        return hollow;
    }
    std::span<const std::size_t> cells() const { return cells_; }

  private:
    std::size_t columns() const { return static_cast<std::size_t>(map_.columns); }
    bool is_inside(int column, int row) const {
        return column > 0 && row > 0 && column + 1 < map_.columns && row + 1 < map_.rows;
    }
    bool is_near_wall(int column, int row) const {
        for (int steps = 1; steps <= most_steps_; ++steps)
            if (any_on_rim(map_, column, row, steps,
                           [&](int i, int j) { return map_.is_solid(i, j); }))
                return true;
        return false;
    }
    void add_neighbours(int column, int row) {
        for (const auto& [i, j] : {std::pair{column - 1, row},
                                   {column + 1, row},
                                   {column, row - 1},
                                   {column, row + 1}}) {
            if (i < 0 || j < 0 || i >= map_.columns || j >= map_.rows) continue;
            const std::size_t cell =
                static_cast<std::size_t>(j) * columns() + static_cast<std::size_t>(i);
            if (seen_[cell]) continue;
            seen_[cell] = true;
            cells_.push_back(cell);
        }
    }

    const CellMap& map_;
    int most_steps_;
    std::vector<bool> seen_;
    std::size_t first_ = 0;
    std::vector<std::size_t> cells_;
};

/// Whether for most of the solid cells around an area the far side of the wall is at most a stroke
/// away. @param area  by cell; others are not of the area
bool is_outlined(const CellMap& map, std::span<const std::size_t> cells,
                 const std::vector<bool>& area) {
    const auto columns = static_cast<std::size_t>(map.columns);
    const auto number = [&](int column, int row) {
        return static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
    };
    const auto is_stroke = [&](int column, int row) {
        if (column < widest_stroke || row < widest_stroke ||
            column + widest_stroke >= map.columns || row + widest_stroke >= map.rows)
            return true;
        for (int steps = 1; steps <= widest_stroke; ++steps)
            if (any_on_rim(map, column, row, steps, [&](int i, int j) {
                    return !map.is_solid(i, j) && !area[number(i, j)];
                }))
                return true;
        return false;
    };
    std::vector<std::size_t> border;
    for (const std::size_t cell : cells)
        any_on_rim(map, static_cast<int>(cell % columns), static_cast<int>(cell / columns), 1,
                   [&](int i, int j) {
                       if (map.is_solid(i, j)) border.push_back(number(i, j));
                       return false;
                   });
    std::sort(border.begin(), border.end());
    border.erase(std::unique(border.begin(), border.end()), border.end());
    const auto strokes = std::count_if(border.begin(), border.end(), [&](std::size_t cell) {
        return is_stroke(static_cast<int>(cell % columns), static_cast<int>(cell / columns));
    });
    return 2 * static_cast<std::size_t>(strokes) > border.size();
}

}  // namespace

void for_each_hollow(const CellMap& map, Meters widest,
                     const std::function<void(std::span<const std::size_t> cells)>& visit) {
    for (Areas areas(map, widest); areas.next();)
        if (areas.is_hollow()) visit(areas.cells());
}

HollowWalls::HollowWalls(const MapFrame& frame, std::vector<std::shared_ptr<const WallIndex>> walls)
    : cell_(std::max(frame.cell_width(), frame.cell_height())), walls_(std::move(walls)) {}

const std::vector<bool>& HollowWalls::cells() const {
    found_([this] { find(); });
    return cells_;
}

void HollowWalls::find() const {
    if (walls_.empty()) return;
    const int columns = walls_.front()->columns(), rows = walls_.front()->rows();
    CellMap map{columns, rows, cell_, {}};
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            map.solid.push_back(std::any_of(walls_.begin(), walls_.end(), [&](const auto& layer) {
                return layer->solid(column, row);
            }));
    std::vector<bool> area(map.solid.size(), false);
    const Meters widest{thickest_wall.value - 2 * cell_};  // between two strokes
    for_each_hollow(map, widest, [&](std::span<const std::size_t> cells) {
        for (const std::size_t cell : cells) area[cell] = true;
        if (is_outlined(map, cells, area)) {
            cells_.resize(map.solid.size(), false);
            for (const std::size_t cell : cells) cells_[cell] = true;
        }
        for (const std::size_t cell : cells) area[cell] = false;
    });
}

bool HollowWalls::holds(int column, int row) const {
    const std::vector<bool>& all = cells();
    if (all.empty()) return false;
    const int columns = walls_.front()->columns(), rows = walls_.front()->rows();
    return column >= 0 && row >= 0 && column < columns && row < rows &&
           all[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(column)];
}

bool HollowWalls::holds(CellPoint p) const {
    constexpr double most = 1e9;  // [cells]
    return std::abs(p.u) < most && std::abs(p.v) < most &&
           holds(static_cast<int>(std::floor(p.u)), static_cast<int>(std::floor(p.v)));
}

}  // namespace rovernet
