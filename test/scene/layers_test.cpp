// SPDX-License-Identifier: MIT
// Scenes of several maps, materials and heights.
#include "scene/planning_grid.hpp"
#include "scene/scene.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace layers_test {
using namespace rovernet;
using test::drawn_map;

namespace {

/// Some roundings of coordinates up to 100 m.
constexpr double tolerance = 1e-12;  // [m]
constexpr double infinite = std::numeric_limits<double>::infinity();

bool near(double a, double b) { return std::abs(a - b) <= tolerance; }

/// A box of walls: one cell.
OccupancyGrid box(double x, double y, double width, double height, double yaw = 0) {
    OccupancyGrid grid;
    grid.columns = grid.rows = 1;
    grid.cell_width = width;
    grid.cell_height = height;
    grid.origin = {x, y, 0};
    grid.yaw = yaw;
    grid.cells = {Cell::occupied};
    return grid;
}

double loss(const Scene& scene, Vec3 a, Vec3 b, const std::vector<WallRate>& rates) {
    std::vector<Crossing> scratch;
    return scene.wall_loss(a, b, rates, infinite, scratch);
}

const Material brick{.name = "brick", .per_crossing = Db{3}};
const Material wood{.name = "wood", .per_metre = DbPerMeter{10}};

}  // namespace

TEST_CASE(
    "layers: a ray through adjacent walls has one crossing if their material is equal, otherwise "
    "two") {
    OccupancyGrid grid = drawn_map({".####."});
    grid.cell_materials = {0, 1, 1, 2, 2, 0};
    const Scene scene(grid, {Material{}, brick, wood});
    const auto two = scene.crossings({0.5, 0.5}, {5.5, 0.5});
    REQUIRE(two.size() == 2);
    CHECK(two[0].material == 1);
    CHECK(near(two[0].length, 2));
    CHECK(two[1].material == 2);
    CHECK(near(two[1].entry, 2.5));
    CHECK(near(two[1].exit, 4.5));
    CHECK_FALSE(scene.plain_walls());
    CHECK(near(loss(scene, {0.5, 0.5}, {5.5, 0.5}, {{}, {3, 0}, {0, 10}}), 3 + 20));
    grid.cell_materials = {0, 1, 1, 1, 1, 0};
    CHECK(Scene(grid, {Material{}, brick}).crossings({0.5, 0.5}, {5.5, 0.5}).size() == 1);
}

TEST_CASE("layers: the loss of walls is equal in both directions of a link, to the last bit") {
    OccupancyGrid grid = drawn_map({"##.#", ".#.#", "####"}, 0.37);
    grid.cell_materials = {0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2};
    OccupancyGrid turned = box(0.4, -0.2, 0.3, 0.7, 0.5);
    turned.material = 1;
    const Scene scene({grid, turned}, {Material{.height = Meters{0.8}}, brick, wood});
    const std::vector<WallRate> rates{{0.1, 7}, {3, 0.3}, {0, 10.7}};
    for (int i = 0; i < 500; ++i) {
        const double x = 0.0031 * i, y = 0.0019 * i;
        const Vec3 a{-0.3, y, 0.3 + x}, b{1.9 - x, 1.3 - y, 1.1};
        CHECK(loss(scene, a, b, rates) == loss(scene, b, a, rates));
        CHECK(scene.wall_length(a, b) == scene.wall_length(b, a));
    }
}

TEST_CASE(
    "layers: where two walls overlap, the common length counts twice only if their materials "
    "differ") {
    const Scene same({box(1, 0, 2, 1), box(2, 0, 2, 1)}, {Material{}});
    CHECK(near(same.wall_length({0, 0.5}, {9, 0.5}), 3));
    CHECK(same.crossings({0, 0.5}, {9, 0.5}).size() == 1);
    OccupancyGrid other = box(2, 0, 2, 1);
    other.material = 1;
    const Scene two({box(1, 0, 2, 1), other}, {Material{}, brick});
    CHECK(near(two.wall_length({0, 0.5}, {9, 0.5}), 4));
}

TEST_CASE(
    "layers: a ray along the diagonal of a turned box is inside the box for the diagonal's "
    "length") {
    const double half_turn = 3.14159265358979323846 / 4;
    const Scene scene(box(5, 0, 2, 2, half_turn));
    CHECK(near(scene.wall_length({0, std::sqrt(2)}, {10, std::sqrt(2)}), 2 * std::sqrt(2)));
}

TEST_CASE(
    "layers: a link above a wall is outside the wall, a link through the wall's top is partly "
    "inside") {
    const Scene scene(box(4, 0, 2, 1), {Material{.height = Meters{2}}});
    CHECK(near(scene.wall_length({0, 0.5, 1}, {10, 0.5, 1}), 2));
    CHECK(scene.wall_length({0, 0.5, 2}, {10, 0.5, 2}) == 0);
    CHECK(scene.wall_length({0, 0.5, 3}, {10, 0.5, 2.5}) == 0);
    // From 0 to 4 m height over 10 m: below 2 m up to x = 5, so inside from x = 4 to 5.
    const double slope = std::sqrt(100.0 + 16.0) / 10;
    CHECK(near(scene.wall_length({0, 0.5, 0}, {10, 0.5, 4}), slope));
    const auto down = scene.crossings({10, 0.5, 4}, {0, 0.5, 0});
    REQUIRE(down.size() == 1);
    CHECK(near(down[0].entry, 5 * slope));
    CHECK_FALSE(scene.plain_walls());
}

TEST_CASE("layers: robots avoid the obstacles of all maps that form a scene") {
    const Scene scene({drawn_map({"....", "...#"}), box(0.2, 0.2, 0.5, 0.1)}, {Material{}});
    CHECK(near(scene.clearance({0.45, 0.7, 0}), 0.4));
    CHECK(near(scene.clearance({2.5, 0.5, 0}), 0.5));
    CHECK_FALSE(scene.passable({0.1, 0.05}, {0.9, 0.5}, Meters{0.05}));
    CHECK(scene.occupied({0.5, 0.25}));
    CHECK_FALSE(scene.occupied({1.5, 0.25}));
    CHECK(scene.occupied_cells() == 2);
}

TEST_CASE("layers: a cell of the planning grid is free only if no obstacle enters it") {
    const std::vector<OccupancyGrid> maps{drawn_map({"........", "....#...", "........"}, 0.5),
                                          box(1.1, 0.3, 1.2, 0.4, 0.3), box(3.6, -0.7, 0.2, 0.5)};
    const Scene scene(maps, {Material{}});
    const OccupancyGrid grid = planning_grid(maps);
    const MapFrame frame(grid);
    int in_doubt = 0;  // cells that an obstacle enters by less than the samples see
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column) {
            bool hit = false;
            for (int k = 0; k < 40'000; ++k) {
                const CellPoint p{column + (k % 200 + 0.5) / 200, row + (k / 200 + 0.5) / 200};
                hit = hit || scene.occupied(frame.to_world(p));
            }
            const bool is_free = grid.at(column, row) == Cell::free;
            in_doubt += !is_free && !hit;
            if (hit) CHECK_FALSE(is_free);
        }
    CHECK(grid.cell_width == 0.5);
    CHECK(in_doubt == 0);
}

TEST_CASE(
    "layers: if a planning grid would have too many cells, its cells are enlarged, but only as "
    "needed") {
    const std::vector<OccupancyGrid> maps{drawn_map({"#..", "..."}, 0.01), box(60, 30, 1, 1)};
    const OccupancyGrid grid = planning_grid(maps);
    const double cells = 1.0 * grid.columns * grid.rows;
    CHECK(cells < 4.1e6);
    CHECK(cells > 3.5e6);
    CHECK(grid.columns * grid.cell_width >= 61);
}

TEST_CASE("layers: an unknown material is refused") {
    OccupancyGrid grid = box(0, 0, 1, 1);
    grid.material = 1;
    CHECK_THROWS_AS(Scene{grid}, std::invalid_argument);
    grid.cell_materials = {0, 0};
    CHECK_THROWS_AS(Scene(grid, {Material{}, brick}), std::invalid_argument);
}

}  // namespace layers_test
