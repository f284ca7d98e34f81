// SPDX-License-Identifier: MIT
#include "live/rosbridge/square_cells.hpp"

#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace square_cells_test {
using namespace rovernet;
using test::Draw;
using test::drawn_map;

namespace {

std::vector<std::string> drawing(const OccupancyGrid& map) {
    std::vector<std::string> rows;
    for (int row = map.rows - 1; row >= 0; --row) {
        std::string line;
        for (int column = 0; column < map.columns; ++column) {
            const Cell cell = map.at(column, row);
            line += cell == Cell::occupied ? '#' : cell == Cell::unknown ? '?' : '.';
        }
        rows.push_back(line);
    }
    return rows;
}

}  // namespace

TEST_CASE(
    "square cells: a map with oblong cells is redrawn in square cells, with the same walls and "
    "extent") {
    OccupancyGrid wide = drawn_map({"#.", "?."});
    wide.cell_width = 0.2;
    wide.cell_height = 0.1;
    CHECK(drawing(square_cells(wide)) == std::vector<std::string>{"##..", "??.."});
    CHECK(square_cells(wide).cell_width == 0.1);

    OccupancyGrid high = drawn_map({"#..", "..?"});
    high.cell_height = 1.5;
    high.origin = {-2, 3};
    high.yaw = 0.3;
    const OccupancyGrid square = square_cells(high);
    CHECK(drawing(square) == std::vector<std::string>{"#..", "#.?", "..?"});
    CHECK(square.origin == high.origin);
    CHECK(square.yaw == 0.3);

    // hospital_section.png of Stage, in a floorplan of 40 m x 18 m
    OccupancyGrid hospital = drawn_map(std::vector<std::string>(443, std::string(1082, '.')));
    hospital.cell_width = 40.0 / 1082;
    hospital.cell_height = 18.0 / 443;
    const OccupancyGrid section = square_cells(hospital);
    CHECK(section.columns == 1100);
    CHECK(section.rows == 495);
    CHECK(std::abs(section.cell_width - 40.0 / 1100) < 1e-12);
    CHECK(section.cell_height == section.cell_width);
}

TEST_CASE(
    "square cells: no wall is lost or moved, whatever the width and height of the old cells") {
    Draw draw(11);
    for (int i = 0; i < 50; ++i) {
        OccupancyGrid map = test::random_map(draw, 23, 17, 10);
        map.cell_width = draw.uniform(0.05, 0.2);
        map.cell_height = draw.uniform(0.05, 0.2);
        const OccupancyGrid square = square_cells(map);
        const double side = square.cell_width;
        CHECK(square.cell_height == side);
        CHECK(side <= std::min(map.cell_width, map.cell_height) + 1e-12);
        CHECK(square.columns * side < map.columns * map.cell_width + side);
        CHECK(square.rows * side < map.rows * map.cell_height + side);
        for (int j = 0; j < 1000; ++j) {
            const double x = draw.uniform(0, map.columns * map.cell_width);
            const double y = draw.uniform(0, map.rows * map.cell_height);
            const auto at = [&](const OccupancyGrid& grid, double dx, double dy) {
                return grid.at(static_cast<int>((x + dx) / grid.cell_width),
                               static_cast<int>((y + dy) / grid.cell_height));
            };
            const Cell now = at(square, 0, 0);
            if (at(map, 0, 0) == Cell::occupied) CHECK(now == Cell::occupied);
            if (now != Cell::occupied) continue;
            bool is_near_wall = false;
            for (int row = 0; row < map.rows; ++row) {
                for (int column = 0; column < map.columns; ++column) {
                    if (map.at(column, row) != Cell::occupied) continue;
                    const double left = column * map.cell_width - side;
                    const double low = row * map.cell_height - side;
                    is_near_wall |= x > left && x < left + map.cell_width + 2 * side && y > low &&
                                    y < low + map.cell_height + 2 * side;
                }
            }
            CHECK(is_near_wall);
        }
    }
}

}  // namespace square_cells_test
