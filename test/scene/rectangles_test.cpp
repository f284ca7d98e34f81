// SPDX-License-Identifier: MIT
#include "scene/rectangles.hpp"

#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace rectangles_test {
using namespace rovernet;
using test::drawn_map;

namespace {

/// How many rectangles cover each cell.
std::vector<int> cover_count(const OccupancyGrid& grid,
                             const std::vector<CellRectangle>& rectangles) {
    std::vector<int> count(grid.cells.size());
    for (const CellRectangle& r : rectangles)
        for (int row = r.row0; row < r.row1; ++row)
            for (int column = r.column0; column < r.column1; ++column)
                ++count[static_cast<std::size_t>(row * grid.columns + column)];
    return count;
}

}  // namespace

TEST_CASE(
    "rectangles: the rectangles of a map cover exactly the occupied cells and never overlap") {
    test::Draw draw(1);
    for (int trial = 0; trial < 60; ++trial) {
        const OccupancyGrid grid =
            test::random_map(draw, 1 + draw.below(40), 1 + draw.below(40), draw.below(101));
        const auto count = cover_count(grid, solid_rectangles(grid, Solid::walls));
        for (std::size_t i = 0; i < count.size(); ++i)
            REQUIRE(count[i] == (grid.cells[i] == Cell::occupied ? 1 : 0));
    }
}

TEST_CASE("rectangles: a full map becomes one rectangle, an empty map none") {
    CHECK(solid_rectangles(drawn_map({"###", "###"}), Solid::walls) ==
          std::vector<CellRectangle>{{0, 0, 3, 2}});
    CHECK(solid_rectangles(drawn_map({"...", "..."}), Solid::walls).empty());
    CHECK(solid_rectangles(OccupancyGrid{}, Solid::walls).empty());
}

TEST_CASE("rectangles: a rectangle grows first right or first up, whichever makes it larger") {
    CHECK(solid_rectangles(drawn_map({"#..", "#..", "#..", "##."}), Solid::walls) ==
          std::vector<CellRectangle>{{0, 0, 1, 4}, {1, 0, 2, 1}});
    CHECK(solid_rectangles(drawn_map({"#..", "###"}), Solid::walls) ==
          std::vector<CellRectangle>{{0, 0, 3, 1}, {0, 1, 1, 2}});
}

TEST_CASE("rectangles: unknown cells are obstacles, but not walls") {
    const OccupancyGrid grid = drawn_map({"?#?", "..."});
    CHECK(solid_rectangles(grid, Solid::walls) == std::vector<CellRectangle>{{1, 1, 2, 2}});
    CHECK(solid_rectangles(grid, Solid::obstacles) == std::vector<CellRectangle>{{0, 1, 3, 2}});
}

}  // namespace rectangles_test
