// SPDX-License-Identifier: MIT
#include "scene/redrawing.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rovernet {
namespace {

std::size_t cell_number(const OccupancyGrid& map, int column, int row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(map.columns) +
           static_cast<std::size_t>(column);
}

/// The map's place and materials, with free cells of another size.
OccupancyGrid regridded(const OccupancyGrid& map, int columns, int rows, double scale) {
    OccupancyGrid out;
    out.columns = columns;
    out.rows = rows;
    out.cell_width = scale * map.cell_width;
    out.cell_height = scale * map.cell_height;
    out.origin = map.origin;
    out.yaw = map.yaw;
    out.material = map.material;
    const auto cells = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    out.cells.assign(cells, Cell::free);
    if (!map.cell_materials.empty()) out.cell_materials.assign(cells, 0);
    return out;
}

void copy_cell(const OccupancyGrid& from, std::size_t i, OccupancyGrid& to, std::size_t j) {
    to.cells[j] = from.cells[i];
    if (!from.cell_materials.empty()) to.cell_materials[j] = from.cell_materials[i];
}

/// Calls visit(number) for the neighbours of a cell that lie on the map, the cell among them.
template <class Visit>
void around(const OccupancyGrid& map, std::size_t cell, Visit visit) {
    const int column = static_cast<int>(cell % static_cast<std::size_t>(map.columns));
    const int row = static_cast<int>(cell / static_cast<std::size_t>(map.columns));
    for (int j = std::max(row - 1, 0); j <= std::min(row + 1, map.rows - 1); ++j) {
        for (int i = std::max(column - 1, 0); i <= std::min(column + 1, map.columns - 1); ++i) {
            visit(cell_number(map, i, j));
        }
    }
}

bool on_edge(const OccupancyGrid& map, std::size_t cell) {
    int there = 0;
    around(map, cell, [&](std::size_t) { ++there; });
    return there < 9;
}

bool all_around_occupied(const OccupancyGrid& map, std::size_t cell) {
    int occupied = 0;
    around(map, cell, [&](std::size_t i) { occupied += map.cells[i] == Cell::occupied; });
    return occupied == 9;
}

/// The wall that is nearest to each cell, in steps to one of 8 neighbours; -1: there is no wall.
struct NearestWalls {
    std::vector<int> steps;
    std::vector<std::uint8_t> materials;
};

NearestWalls nearest_walls(const OccupancyGrid& map) {
    NearestWalls out{std::vector(map.cells.size(), -1),
                     std::vector<std::uint8_t>(map.cells.size(), 0)};
    std::vector<std::size_t> queue;
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
        if (map.cells[i] != Cell::occupied) continue;
        out.steps[i] = 0;
        out.materials[i] = map.material_of(i);
        queue.push_back(i);
    }
    for (std::size_t next = 0; next < queue.size(); ++next) {
        const std::size_t here = queue[next];
        around(map, here, [&](std::size_t i) {
            if (out.steps[i] >= 0) return;
            out.steps[i] = out.steps[here] + 1;
            out.materials[i] = out.materials[here];
            queue.push_back(i);
        });
    }
    return out;
}

/// Cells of an area between walls, joined by their sides.
std::vector<std::size_t> area_of(const OccupancyGrid& map, std::size_t cell,
                                 std::vector<bool>& seen) {
    const auto columns = static_cast<std::size_t>(map.columns);
    std::vector<std::size_t> area{cell};
    seen[cell] = true;
    const auto add = [&](bool there, std::size_t i) {
        if (!there || seen[i] || map.cells[i] == Cell::occupied) return;
        seen[i] = true;
        area.push_back(i);
    };
    for (std::size_t next = 0; next < area.size(); ++next) {
        const std::size_t here = area[next];
        add(here % columns > 0, here - 1);
        add((here + 1) % columns > 0, here + 1);
        add(here >= columns, here - columns);
        add(here + columns < map.cells.size(), here + columns);
    }
    return area;
}

}  // namespace

OccupancyGrid split_cells(const OccupancyGrid& map) {
    OccupancyGrid out = regridded(map, 2 * map.columns, 2 * map.rows, 0.5);
    for (int row = 0; row < out.rows; ++row) {
        for (int column = 0; column < out.columns; ++column) {
            copy_cell(map, cell_number(map, column / 2, row / 2), out,
                      cell_number(out, column, row));
        }
    }
    return out;
}

OccupancyGrid join_cells(const OccupancyGrid& map) {
    if (map.columns < 2 || map.rows < 2) return map;
    OccupancyGrid out = regridded(map, (map.columns + 1) / 2, (map.rows + 1) / 2, 2);
    for (int row = 0; row < map.rows; ++row) {
        for (int column = 0; column < map.columns; ++column) {
            const std::size_t from = cell_number(map, column, row);
            const std::size_t to = cell_number(out, column / 2, row / 2);
            const bool is_more = map.cells[from] == Cell::occupied || out.cells[to] == Cell::free;
            if (is_more && out.cells[to] != Cell::occupied) copy_cell(map, from, out, to);
        }
    }
    return out;
}

OccupancyGrid outline_walls(const OccupancyGrid& map) {
    OccupancyGrid out = map;
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
        if (all_around_occupied(map, i)) out.cells[i] = Cell::free;
    }
    return out;
}

OccupancyGrid fill_walls(const OccupancyGrid& map, Meters widest) {
    OccupancyGrid out = map;
    const NearestWalls walls = nearest_walls(map);
    const double cell = std::max(map.cell_width, map.cell_height);
    std::vector<bool> seen(map.cells.size(), false);
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
        if (seen[i] || map.cells[i] == Cell::occupied) continue;
        const std::vector<std::size_t> area = area_of(map, i, seen);
        const bool is_hollow = std::all_of(area.begin(), area.end(), [&](std::size_t c) {
            return !on_edge(map, c) && (2 * walls.steps[c] - 1) * cell <= widest.value;
        });
        if (!is_hollow) continue;
        for (const std::size_t c : area) {
            out.cells[c] = Cell::occupied;
            if (!out.cell_materials.empty()) out.cell_materials[c] = walls.materials[c];
        }
    }
    return out;
}

}  // namespace rovernet
