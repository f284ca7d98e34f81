// SPDX-License-Identifier: MIT
#include "mobility/free_space.hpp"

#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace free_space_test {
using namespace rovernet;

namespace {

Vec3 centre(const Scene& scene, int column, int row) {
    return scene.frame().to_world({column + 0.5, row + 0.5});
}

}  // namespace

TEST_CASE("free space: a cell is free exactly if the robot fits at the cell's centre") {
    test::Draw draw(21);
    for (const double radius : {0.0, 0.1, 0.25, 0.3, 0.5, 1.25, 4.0}) {
        OccupancyGrid grid = test::random_map(draw, 60, 45, 1);
        grid.cell_width = 0.5;
        grid.cell_height = 0.25;
        grid.cells[100] = Cell::unknown;
        const Scene scene(grid);
        const FreeSpace space(scene, Meters{radius});
        for (int row = 0; row < 45; ++row)
            for (int column = 0; column < 60; ++column) {
                const Vec3 p = centre(scene, column, row);
                REQUIRE((space.free[static_cast<std::size_t>(row * 60 + column)] != 0) ==
                        scene.passable(p, p, Meters{radius}));
            }
    }
}

TEST_CASE(
    "free space: a step between cells is allowed exactly where the robot fits and cuts no corner") {
    test::Draw draw(22);
    for (const double radius : {0.0, 0.2, 0.5, 0.6, 1.0, 1.5, 2.7}) {
        const Scene scene(test::random_map(draw, 40, 50, 1));
        const FreeSpace space(scene, Meters{radius});
        const auto free = [&](int i, int j) {
            return i >= 0 && i < 40 && j >= 0 && j < 50 &&
                   space.free[static_cast<std::size_t>(j * 40 + i)];
        };
        for (int j = 0; j < 50; ++j)
            for (int i = 0; i < 40; ++i)
                for (std::size_t d = 0; d < cell_steps.size(); ++d) {
                    const int column = i + cell_steps[d].column, row = j + cell_steps[d].row;
                    const bool allowed = free(i, j) && free(column, row) && free(i, row) &&
                                         free(column, j) &&
                                         scene.passable(centre(scene, i, j),
                                                        centre(scene, column, row), Meters{radius});
                    const auto steps = space.steps[static_cast<std::size_t>(j * 40 + i)];
                    REQUIRE(((steps >> d & 1) != 0) == allowed);
                }
    }
}

TEST_CASE("free space: a robot fits into a corridor of exactly its own width, at any cell size") {
    for (const int centimetres : {3, 5, 10, 15, 30})
        for (std::size_t width = 1; width <= 21; width += 2) {
            std::vector<std::string> rows(width + 2, ".....");
            rows.front() = rows.back() = "#####";
            const Scene scene(test::drawn_map(rows, centimetres / 100.0));
            const double radius = centimetres * static_cast<double>(width) / 200;
            const std::size_t middle = (width + 2) / 2 * 5 + 2;
            CHECK(FreeSpace(scene, Meters{radius}).steps[middle] == 0b00010001);  // along it
            CHECK(FreeSpace(scene, Meters{radius + 1e-8}).free[middle] == 0);
        }
}

TEST_CASE(
    "free space: free cells connected by steps form a region; regions are numbered in cell order") {
    test::Draw draw(23);
    for (int trial = 0; trial < 30; ++trial) {
        const int columns = 1 + draw.below(40), rows = 1 + draw.below(30);
        const Scene scene(test::random_map(draw, columns, rows, draw.below(60)));
        const FreeSpace space(scene, Meters{0.1 * draw.below(9)});
        std::vector<std::int32_t> part(space.part.size(), -1);  // by flooding along the steps
        std::int32_t number = 0;
        for (std::size_t first = 0; first < part.size(); ++first) {
            if (!space.free[first] || part[first] >= 0) continue;
            std::vector<std::size_t> open{first};
            while (!open.empty()) {
                const std::size_t cell = open.back();
                open.pop_back();
                part[cell] = number;
                for (std::size_t d = 0; d < cell_steps.size(); ++d) {
                    const auto next = static_cast<std::size_t>(
                        static_cast<std::ptrdiff_t>(cell) +
                        std::ptrdiff_t{cell_steps[d].row} * columns + cell_steps[d].column);
                    if ((space.steps[cell] >> d & 1) && part[next] < 0) open.push_back(next);
                }
            }
            ++number;
        }
        REQUIRE(space.part == part);
    }
}

TEST_CASE(
    "free space: if robots may leave the map, cells are added around it, and the outermost are "
    "free") {
    for (const double radius : {0.0, 0.2, 0.5, 3.3}) {
        OccupancyGrid grid = test::drawn_map({"#..#", ".#..", "##.#"}, 0.5);
        const FreeSpace bordered(Scene(grid), Meters{radius});
        CHECK(bordered.margin == 0);
        grid.open_ground = true;
        const Scene scene(grid);
        const FreeSpace open(scene, Meters{radius});
        REQUIRE(open.margin > 0);
        REQUIRE(open.free.size() == static_cast<std::size_t>(open.columns * open.rows));
        for (int cell = 0; cell < open.columns * open.rows; ++cell) {
            const int column = cell % open.columns, row = cell / open.columns;
            const CellPoint p = open.centre(cell);
            CHECK(p == CellPoint{column - open.margin + 0.5, row - open.margin + 0.5});
            const Vec3 at = scene.frame().to_world(p);
            const bool is_free = open.free[static_cast<std::size_t>(cell)] != 0;
            CHECK(is_free == scene.passable(at, at, Meters{radius}));
            const bool is_outermost =
                column == 0 || row == 0 || column == open.columns - 1 || row == open.rows - 1;
            if (is_outermost) CHECK(is_free);
        }
    }
}

TEST_CASE("free space: a robot larger than the map fits nowhere near a wall") {
    const Scene scene(test::drawn_map({"....", ".#..", "...."}, 0.5));
    for (const double radius : {10.0, 1e9, 1e300}) {
        const FreeSpace space(scene, Meters{radius});
        CHECK(space.free == std::vector<std::uint8_t>(12, 0));
        CHECK(space.part == std::vector<std::int32_t>(12, -1));
    }
}

}  // namespace free_space_test
