// SPDX-License-Identifier: MIT
#include "scene/planning_grid.hpp"

#include "scene/map_frame.hpp"
#include "scene/rectangles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rovernet {
namespace {

constexpr double most_cells = 4e6;
constexpr double cell_without_maps = 0.05;  // [m], if there are lone walls only
constexpr double shrink = 1e-9;             // [cells]: what only touches a cell does not enter it

/// Axis-parallel box in cells of the new grid.
struct Bounds {
    double left = std::numeric_limits<double>::infinity();
    double bottom = std::numeric_limits<double>::infinity();
    double right = -std::numeric_limits<double>::infinity();
    double top = -std::numeric_limits<double>::infinity();

    void add(CellPoint p) {
        left = std::min(left, p.u);
        bottom = std::min(bottom, p.v);
        right = std::max(right, p.u);
        top = std::max(top, p.v);
    }
};

using Corners = std::array<CellPoint, 4>;

Corners corners(const CellRectangle& r, const MapFrame& from, const MapFrame& to) {
    const double left = r.column0, bottom = r.row0, right = r.column1, top = r.row1;
    return {to.to_cells(from.to_world({left, bottom})), to.to_cells(from.to_world({right, bottom})),
            to.to_cells(from.to_world({right, top})), to.to_cells(from.to_world({left, top}))};
}

Bounds bounds(const Corners& corners) {
    Bounds box;
    for (const CellPoint p : corners) box.add(p);
    return box;
}

/// Whether the whole cell lies beyond one side of the (counter-clockwise) rectangle.
bool apart(const Corners& rectangle, int column, int row) {
    for (std::size_t i = 0; i < 4; ++i) {
        const CellPoint p = rectangle[i], q = rectangle[(i + 1) % 4];
        const double du = q.u - p.u, dv = q.v - p.v;
        // Corner of the cell that is farthest to the left of the side.
        const double u = column + (dv < 0 ? 1 : 0), v = row + (du > 0 ? 1 : 0);
        if (du * (v - p.v) - dv * (u - p.u) <= shrink * std::sqrt(du * du + dv * dv)) return true;
    }
    return false;
}

void mark(OccupancyGrid& grid, const Corners& rectangle) {
    const Bounds box = bounds(rectangle);
    const auto low = [](double x) { return static_cast<int>(std::floor(x + shrink)); };
    const auto high = [](double x) { return static_cast<int>(std::ceil(x - shrink)); };
    const int right = std::min(high(box.right), grid.columns);
    const int top = std::min(high(box.top), grid.rows);
    for (int row = std::max(low(box.bottom), 0); row < top; ++row)
        for (int column = std::max(low(box.left), 0); column < right; ++column)
            if (!apart(rectangle, column, row))
                grid.cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
                           static_cast<std::size_t>(column)] = Cell::occupied;
}

/// Grid without cells: only placement and size.
OccupancyGrid lines(const std::vector<OccupancyGrid>& maps) {
    OccupancyGrid grid;
    grid.cell_width = grid.cell_height = cell_without_maps;
    grid.origin = maps.front().origin;
    grid.open_ground = maps.front().open_ground;
    bool found = false;
    for (const OccupancyGrid& map : maps) {
        if (map.cells.size() <= 1) continue;
        if (!found) {
            grid.cell_width = map.cell_width;
            grid.cell_height = map.cell_height;
            grid.origin = map.origin;
            grid.yaw = map.yaw;
        }
        found = true;
        grid.cell_width = std::min(grid.cell_width, map.cell_width);
        grid.cell_height = std::min(grid.cell_height, map.cell_height);
    }
    return grid;
}

Bounds extent(const std::vector<OccupancyGrid>& maps, const MapFrame& frame) {
    Bounds all;
    for (const OccupancyGrid& map : maps)
        for (const CellPoint p : corners({0, 0, map.columns, map.rows}, MapFrame(map), frame))
            all.add(p);
    return all;
}

}  // namespace

OccupancyGrid planning_grid(const std::vector<OccupancyGrid>& maps) {
    OccupancyGrid grid = lines(maps);
    Bounds all = extent(maps, MapFrame(grid));
    const double cells = (all.right - all.left + 2) * (all.top - all.bottom + 2);
    if (cells > most_cells) {
        const double scale = std::sqrt(cells / most_cells);
        grid.cell_width *= scale;
        grid.cell_height *= scale;
        all = extent(maps, MapFrame(grid));
    }
    const double left = std::floor(all.left + shrink), bottom = std::floor(all.bottom + shrink);
    grid.origin = MapFrame(grid).to_world({left, bottom}, grid.origin.z);
    grid.columns = std::max(1, static_cast<int>(std::ceil(all.right - shrink) - left));
    grid.rows = std::max(1, static_cast<int>(std::ceil(all.top - shrink) - bottom));
    grid.cells.assign(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows),
                      Cell::free);
    const MapFrame frame(grid);
    for (const OccupancyGrid& map : maps)
        for (const CellRectangle& r : solid_rectangles(map, Solid::obstacles))
            mark(grid, corners(r, MapFrame(map), frame));
    return grid;
}

}  // namespace rovernet
