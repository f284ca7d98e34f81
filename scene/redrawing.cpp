// SPDX-License-Identifier: MIT
#include "scene/redrawing.hpp"

#include "scene/hollow_walls.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rovernet {
namespace {

std::size_t cell_number(const OccupancyGrid& map, int column, int row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(map.columns) +
           static_cast<std::size_t>(column);
}

/// Map with the same placement and materials, and free cells of another size.
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

/// Calls visit(number) for a cell and its neighbours within the map.
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

bool all_around_occupied(const OccupancyGrid& map, std::size_t cell) {
    int occupied = 0;
    around(map, cell, [&](std::size_t i) { occupied += map.cells[i] == Cell::occupied; });
    return occupied == 9;
}

/// Material of the nearest wall of each cell, in steps to one of 8 neighbours.
std::vector<std::uint8_t> nearest_materials(const OccupancyGrid& map) {
    std::vector<std::uint8_t> materials(map.cells.size(), 0);
    std::vector<bool> reached(map.cells.size(), false);
    std::vector<std::size_t> queue;
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
        if (map.cells[i] != Cell::occupied) continue;
        reached[i] = true;
        materials[i] = map.material_of(i);
        queue.push_back(i);
    }
    for (std::size_t next = 0; next < queue.size(); ++next) {
        const std::size_t here = queue[next];
        around(map, here, [&](std::size_t i) {
            if (reached[i]) return;
            reached[i] = true;
            materials[i] = materials[here];
            queue.push_back(i);
        });
    }
    return materials;
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
    CellMap cells{map.columns, map.rows, std::max(map.cell_width, map.cell_height), {}};
    for (const Cell cell : map.cells) cells.solid.push_back(cell == Cell::occupied);
    const bool one_material = map.cell_materials.empty();
    const auto materials = one_material ? std::vector<std::uint8_t>{} : nearest_materials(map);
    for_each_hollow(cells, widest, [&](std::span<const std::size_t> hollow) {
        for (const std::size_t c : hollow) {
            out.cells[c] = Cell::occupied;
            if (!one_material) out.cell_materials[c] = materials[c];
        }
    });
    return out;
}

}  // namespace rovernet
