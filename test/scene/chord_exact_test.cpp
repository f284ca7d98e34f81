// SPDX-License-Identifier: MIT
#include "scene/scene.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace chord_exact_test {
using namespace rovernet;

// chord_exact.csv: a segment a-b, a polygon, and the exact length of the segment inside it.

namespace {

/// The vectors carry 15 digits of coordinates up to 6 m.
constexpr double tolerance = 1e-12;  // [m]

struct Row {
    std::string name;
    Vec3 a, b;
    std::string polygon;
    double chord = 0;  ///< [m]
};

std::vector<std::string> comma_separated(const std::string& line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (const char c : line) {
        if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            cells.emplace_back();
        else
            cells.back() += c;
    }
    return cells;
}

std::vector<Row> vectors() {
    std::ifstream file(ROVERNET_TEST_DATA "/chord_exact.csv");
    std::vector<Row> rows;
    std::string line;
    std::getline(file, line);  // the header
    while (std::getline(file, line)) {
        const auto cell = comma_separated(line);
        const auto number = [&](std::size_t i) { return std::stod(cell.at(i)); };
        rows.push_back(
            {cell.at(0), {number(1), number(2)}, {number(3), number(4)}, cell.at(5), number(7)});
    }
    return rows;
}

/// A map around a polygon of axis-parallel edges; each of its cells is inside or outside.
OccupancyGrid map_of(const std::string& polygon) {
    OccupancyGrid grid;
    if (polygon.starts_with("0.0 0.0;1.0")) {  // the unit square
        grid.columns = grid.rows = 1;
        grid.cells = {Cell::occupied};
    } else if (polygon.starts_with("2.0 -5.0;2.15")) {  // the thin wall: 3 cells of 5 cm
        grid.columns = 45;
        grid.rows = 2;
        grid.cell_width = 0.05;
        grid.cell_height = 5;
        grid.origin = {0, -5, 0};
        for (int i = 0; i < 2 * 45; ++i)
            grid.cells.push_back(i % 45 >= 40 && i % 45 < 43 ? Cell::occupied : Cell::free);
    } else if (polygon.starts_with("0.0 0.0;3.0")) {  // the L
        grid.columns = grid.rows = 3;
        for (const bool wall : {1, 1, 1, 1, 0, 0, 1, 0, 0})
            grid.cells.push_back(wall ? Cell::occupied : Cell::free);
    } else if (polygon.starts_with("2.0 0.0;3.0")) {  // the square on its corner, sides sqrt(2)
        grid.columns = grid.rows = 1;
        grid.cells = {Cell::occupied};
        grid.cell_width = grid.cell_height = std::sqrt(2.0);
        grid.origin = {2, 0, 0};
        grid.yaw = std::acos(-1.0) / 4;
    } else {
        throw std::invalid_argument("no map for polygon " + polygon);
    }
    return grid;
}

}  // namespace

TEST_CASE(
    "chord_exact: the length inside the polygon equals the published one, in both directions") {
    int checked = 0;
    for (const Row& row : vectors()) {
        // A triangle has a slanted edge; a map of cells has none.
        if (row.polygon.starts_with("0.0 0.0;4.0")) continue;
        CAPTURE(row.name);
        const Scene scene(map_of(row.polygon));
        CHECK(std::abs(scene.wall_length(row.a, row.b) - row.chord) <= tolerance);
        CHECK(scene.wall_length(row.a, row.b) == scene.wall_length(row.b, row.a));
        ++checked;
    }
    CHECK(checked == 22);
}

}  // namespace chord_exact_test
