// SPDX-License-Identifier: MIT
#include "scene/scene.hpp"

#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace scene_test {
using namespace rovernet;
using test::drawn_map;

namespace {

/// A few roundings of coordinates up to 100 m.
constexpr double tolerance = 1e-12;  // [m]

constexpr double pi = 3.14159265358979323846;

bool near(double a, double b, double within = tolerance) { return std::abs(a - b) <= within; }

/// Two rooms joined by a door, with a pillar; 6 x 5 cells.
OccupancyGrid rooms() {
    return drawn_map({
        "######",
        "#.#..#",
        "#....#",
        "#.#..#",
        "######",
    });
}

/// Distance between a segment and a rectangle by walking along both; good to about 1e-3.
double walked_distance(Vec3 a, Vec3 b, double x0, double y0, double x1, double y1) {
    constexpr int parts = 2000;
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= parts; ++i) {
        const Vec3 p = a + (1.0 * i / parts) * (b - a);
        const double dx = std::max({0.0, x0 - p.x, p.x - x1});
        const double dy = std::max({0.0, y0 - p.y, p.y - y1});
        nearest = std::min(nearest, std::sqrt(dx * dx + dy * dy));
    }
    return nearest;
}

}  // namespace

TEST_CASE("scene: an open field has no walls, no obstacles and no borders") {
    const Scene field;
    CHECK(field.open_field());
    CHECK(field.crossings({0, 0}, {1000, 1000}).empty());
    CHECK(field.wall_length({0, 0}, {1000, 1000}) == 0);
    CHECK_FALSE(field.occupied({0, 0}));
    CHECK(field.inside_map({-1e9, 1e9}));
    CHECK(field.clearance({0, 0}) == std::numeric_limits<double>::infinity());
    CHECK(field.passable({0, 0}, {1e9, 1e9}, 100_m));
    CHECK(field.occupied_cells() == 0);
    CHECK(field.wall_rectangles().empty());
    CHECK(field.lower_left() == Vec3{0, 0, 0});
    CHECK(field.upper_right() == Vec3{0, 0, 0});
}

TEST_CASE("scene: an invalid grid is refused") {
    OccupancyGrid grid = drawn_map({"#."});
    CHECK_NOTHROW(Scene{grid});
    grid.cells.pop_back();
    CHECK_THROWS_AS(Scene{grid}, std::invalid_argument);
    grid = drawn_map({"#."});
    grid.cell_width = 0;
    CHECK_THROWS_AS(Scene{grid}, std::invalid_argument);
    grid = drawn_map({"#."});
    grid.yaw = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(Scene{grid}, std::invalid_argument);
    grid = drawn_map({"#."});
    grid.rows = -1;
    CHECK_THROWS_AS(Scene{grid}, std::invalid_argument);
}

TEST_CASE(
    "crossings: entry and exit are the distances at which the segment enters and leaves a wall") {
    const Scene scene(drawn_map({"..#...##.."}, 0.5));
    const auto found = scene.crossings({0, 0.25}, {5, 0.25});
    REQUIRE(found.size() == 2);
    CHECK(near(found[0].entry, 1));
    CHECK(near(found[0].exit, 1.5));
    CHECK(near(found[0].length, 0.5));
    CHECK(near(found[1].entry, 3));
    CHECK(near(found[1].exit, 4));
    CHECK(near(found[1].length, 1));
    const auto back = scene.crossings({5, 0.25}, {0, 0.25});
    REQUIRE(back.size() == 2);
    CHECK(near(back[0].entry, 1));
    CHECK(near(back[0].exit, 2));
    CHECK(back[0].length == found[1].length);
    CHECK(back[1].length == found[0].length);
}

TEST_CASE(
    "crossings: distances are measured along the sloped segment, not in the horizontal plane") {
    const Scene scene(drawn_map({".#.."}));
    const auto found = scene.crossings({0, 0.5, 0}, {4, 0.5, 3});  // 5 m long over 4 cells
    REQUIRE(found.size() == 1);
    CHECK(near(found[0].entry, 1.25));
    CHECK(near(found[0].length, 1.25));
}

TEST_CASE("crossings: a vertical segment has wall length only inside a wall, not on its face") {
    const Scene scene(drawn_map({".##."}));
    CHECK(scene.wall_length({1.5, 0.5, 0}, {1.5, 0.5, 3}) == 3);
    CHECK(scene.wall_length({2, 0.5, 0}, {2, 0.5, 3}) == 3);  // on the edge of two wall cells
    CHECK(scene.wall_length({1, 0.5, 0}, {1, 0.5, 3}) == 0);  // on the face
    CHECK(scene.wall_length({0.5, 0.5, 0}, {0.5, 0.5, 3}) == 0);
    CHECK(scene.wall_length({1.5, 0.5, 3}, {1.5, 0.5, 0}) == 3);
}

TEST_CASE("crossings: a ray along the common edge of two wall cells is inside the wall") {
    const Scene scene(drawn_map({
        "......",
        ".###..",
        ".##.#.",
        "......",
    }));
    const auto found = scene.crossings({0, 2}, {6, 2});
    REQUIRE(found.size() == 1);
    CHECK(near(found[0].entry, 1));
    CHECK(near(found[0].exit, 3));
    CHECK(near(scene.wall_length({2, 0}, {2, 4}), 2));
    CHECK(near(scene.wall_length({2, 4}, {2, 0}), 2));
}

TEST_CASE("crossings: a ray along an outer edge of a wall is outside the wall") {
    const Scene scene(drawn_map({"....", ".##.", ".##.", "...."}));
    CHECK(scene.crossings({0, 1}, {4, 1}).empty());
    CHECK(scene.crossings({0, 3}, {4, 3}).empty());
    CHECK(scene.crossings({1, 0}, {1, 4}).empty());
    CHECK(scene.crossings({3, 4}, {3, 0}).empty());
}

TEST_CASE("crossings: a ray along an edge of the map is outside the wall cells at this edge") {
    const Scene scene(drawn_map({"##", "##"}));
    CHECK(scene.crossings({-1, 0}, {3, 0}).empty());
    CHECK(scene.crossings({2, -1}, {2, 3}).empty());
    CHECK(near(scene.wall_length({-1, 1}, {3, 1}), 2));
}

TEST_CASE("crossings: a ray that only touches a corner of a wall does not cross the wall") {
    const Scene scene(drawn_map({"...", ".#.", "..."}));
    CHECK(scene.crossings({0, 1}, {2, 3}).empty());
    CHECK(scene.crossings({0, 2}, {2, 0}).empty());
    CHECK(scene.crossings({0, 0}, {1, 1}).empty());      // ends on the corner
    CHECK(scene.crossings({1, 1.5}, {0, 1.5}).empty());  // starts on the face, going out
}

TEST_CASE(
    "crossings: if a ray passes from one wall cell to the next at a corner, it stays in the wall") {
    const Scene scene(drawn_map({"....", "..#.", ".#..", "...."}));
    const double diagonal = std::sqrt(2.0);
    REQUIRE(scene.crossings({0, 0}, {4, 4}).size() == 1);
    CHECK(near(scene.wall_length({0, 0}, {4, 4}), 2 * diagonal));
    CHECK(scene.crossings({0, 4}, {4, 0}).empty());  // between the two, through the same corner
    // The same with ends that are not whole cells, so that the fractions are rounded.
    for (double slope : {0.1, 0.3, 0.7, 1.3, 3.1, 7.7}) {
        const auto found = scene.crossings({2 - 1.7, 2 - 1.7 * slope}, {2 + 1.3, 2 + 1.3 * slope});
        CHECK(found.size() == 1);
        CHECK(scene.crossings({2 - 1.7, 2 + 1.7 * slope}, {2 + 1.3, 2 - 1.3 * slope}).empty());
    }
}

TEST_CASE("crossings: a ray through adjacent walls has one crossing") {
    const Scene scene(drawn_map({"#.##", "####", "..#."}));
    const auto found = scene.crossings({-1, 1.2}, {5, 1.7});
    REQUIRE(found.size() == 1);
    CHECK(near(found[0].length, 4 * std::sqrt(1 + 1.0 / 144)));
}

TEST_CASE(
    "crossings: a ray along the face of a wall is outside the wall, in spite of rounding errors") {
    // 0.15 / 0.05 is just below 3, so a point at 0.15 m would lie in the wall of the first map.
    const Scene before(drawn_map({"..#....", "..#...."}, 0.05));
    const Scene behind(drawn_map({"...#...", "...#..."}, 0.05));
    CHECK(before.crossings({0.15, 0}, {0.15, 0.1}).empty());
    CHECK(behind.crossings({0.15, 0}, {0.15, 0.1}).empty());
    CHECK_FALSE(before.occupied({0.15, 0.05}));
    CHECK(behind.occupied({0.15, 0.05}));
    CHECK(near(behind.wall_length({0.175, 0}, {0.175, 0.1}), 0.1));
}

TEST_CASE(
    "crossings: on a rotated map, lengths inside walls have the same bits in both directions of a "
    "link") {
    OccupancyGrid grid = rooms();
    grid.origin = {-3.3, 7.1, 0};
    grid.yaw = 0.7;
    const Scene scene(grid);
    test::Draw draw(5);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 a{draw.uniform(-12, 5), draw.uniform(4, 16), draw.uniform(0, 2)};
        const Vec3 b{draw.uniform(-12, 5), draw.uniform(4, 16), draw.uniform(0, 2)};
        REQUIRE(scene.wall_length(a, b) == scene.wall_length(b, a));
        auto back = scene.crossings(b, a);
        std::reverse(back.begin(), back.end());
        const auto forth = scene.crossings(a, b);
        REQUIRE(forth.size() == back.size());
        for (std::size_t k = 0; k < forth.size(); ++k) REQUIRE(forth[k].length == back[k].length);
    }
}

TEST_CASE(
    "crossings: if map and link are rotated and shifted together, wall lengths and clearances do "
    "not change") {
    OccupancyGrid grid = rooms();
    const Scene plain(grid);
    grid.origin = {2, -1, 0};
    grid.yaw = pi / 6;
    const Scene turned(grid);
    const double c = std::sqrt(3.0) / 2, s = 0.5;
    const auto moved = [&](Vec3 p) {
        return Vec3{2 + c * p.x - s * p.y, -1 + s * p.x + c * p.y, p.z};
    };
    test::Draw draw(6);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 a{draw.uniform(-2, 8), draw.uniform(-2, 7), 1};
        const Vec3 b{draw.uniform(-2, 8), draw.uniform(-2, 7), 0};
        REQUIRE(near(turned.wall_length(moved(a), moved(b)), plain.wall_length(a, b), 1e-11));
        REQUIRE(near(turned.clearance(moved(a)), plain.clearance(a)));
        REQUIRE(turned.occupied(moved(a)) == plain.occupied(a));
    }
}

TEST_CASE(
    "crossings: if the ends of a segment are 1e9 m away, its crossings are finite and in order") {
    const Scene scene(rooms());
    for (const double far : {1e6, 1e9}) {
        const auto found = scene.crossings({-far, 2.5}, {far, 2.5});
        REQUIRE(found.size() == 2);
        CHECK(near(found[0].length, 1, 1e-9 * far));
        CHECK(found[0].exit < found[1].entry);
        CHECK(std::isfinite(scene.wall_length({-far, -far}, {far, far})));
        CHECK(scene.wall_length({far, far}, {far + 1, far}) == 0);
        CHECK(scene.crossings({2.5, -far}, {2.5, far}).size() == 2);
    }
    CHECK(scene.crossings({1.5, 1.5}, {1.5, 1.5}).empty());
    CHECK(scene.crossings({0.5, 0.5}, {0.5, 0.5}).empty());
}

TEST_CASE(
    "wall length: the length is exact up to a given limit; a larger result is only a lower bound") {
    const Scene scene(drawn_map({".#.#.#.#"}));
    CHECK(near(scene.wall_length({0, 0.5}, {8, 0.5}), 4));
    CHECK(scene.wall_length({0, 0.5}, {8, 0.5}, 4.5) == scene.wall_length({0, 0.5}, {8, 0.5}));
    CHECK(scene.wall_length({0, 0.5}, {8, 0.5}, 1.5) > 1.5);
    CHECK(scene.wall_length({0, 0.5}, {8, 0.5}, 0) > 0);
}

TEST_CASE(
    "unknown cells: unknown cells of a map are not walls for radio, but obstacles for robots") {
    const Scene scene(drawn_map({".....", "..?..", "....."}));
    CHECK(scene.wall_length({0, 1.5}, {5, 1.5}) == 0);
    CHECK_FALSE(scene.occupied({2.5, 1.5}));
    CHECK(scene.occupied_cells() == 0);
    CHECK(scene.clearance({2.5, 1.5}) == 0);
    CHECK(near(scene.clearance({1, 1.5}), 1));
    CHECK_FALSE(scene.passable({0, 1.5}, {5, 1.5}, 0_m));
    CHECK(scene.passable({0, 2.6}, {5, 2.6}, 0.5_m));
}

TEST_CASE("occupied: a cell includes its left and lower edges, but not its right and upper edges") {
    const Scene scene(drawn_map({"...", ".#.", "..."}));
    CHECK(scene.occupied({1, 1}));
    CHECK(scene.occupied({1.5, 1.5}));
    CHECK_FALSE(scene.occupied({2, 1.5}));
    CHECK_FALSE(scene.occupied({1.5, 2}));
    CHECK_FALSE(scene.occupied({-1e30, 1e30}));
}

TEST_CASE("inside map: points on the edges of the map are inside") {
    const Scene scene(rooms());
    CHECK(scene.inside_map({0, 0}));
    CHECK(scene.inside_map({6, 5}));
    CHECK_FALSE(scene.inside_map({6.001, 5}));
    CHECK_FALSE(scene.inside_map({3, -0.001}));
}

TEST_CASE("clearance: the clearance of a point is its distance to the nearest wall rectangle") {
    test::Draw draw(7);
    for (int trial = 0; trial < 30; ++trial) {
        OccupancyGrid grid =
            test::random_map(draw, 1 + draw.below(150), 1 + draw.below(150), trial % 3);
        grid.cell_width = 0.25;
        grid.cell_height = 0.5;
        const Scene scene(grid);
        for (int i = 0; i < 50; ++i) {
            const Vec3 p{draw.uniform(-20, 60), draw.uniform(-20, 95), 0};
            double nearest = std::numeric_limits<double>::infinity();
            for (const auto& [corners, material, bottom, top] : scene.wall_rectangles()) {
                const double dx = std::max({0.0, corners[0].x - p.x, p.x - corners[2].x});
                const double dy = std::max({0.0, corners[0].y - p.y, p.y - corners[2].y});
                nearest = std::min(nearest, std::sqrt(dx * dx + dy * dy));
            }
            REQUIRE(near(scene.clearance(p), nearest, 1e-10));
        }
    }
}

TEST_CASE("passable: a robot fits through a gap of exactly its own width") {
    const Scene scene(drawn_map({"#####", ".....", ".....", "#####"}));
    CHECK(scene.passable({0, 2}, {5, 2}, 1_m));
    CHECK_FALSE(scene.passable({0, 2}, {5, 2}, 1.000001_m));
    CHECK_FALSE(scene.passable({0, 2.000001}, {5, 2.000001}, 1_m));
    CHECK(scene.passable({0, 1}, {5, 1}, 0_m));  // a point along the face
    CHECK_FALSE(scene.passable({2, 2}, {2, 3.5}, 0_m));
    CHECK_FALSE(scene.passable({2, -1}, {2, 9}, 0_m));  // straight through, ends far away
}

TEST_CASE("passable: a robot fits through a corridor of exactly its own width, at any cell size") {
    for (const double cell : {0.03, 0.05, 0.1, 0.15, 0.3})
        for (std::size_t width = 1; width <= 20; ++width) {
            std::vector<std::string> rows(width + 2, ".....");
            rows.front() = rows.back() = "#####";
            const Scene scene(drawn_map(rows, cell));
            const double radius = static_cast<double>(width) * cell / 2;
            const double middle = cell + radius;
            CHECK(scene.passable({0, middle}, {1, middle}, Meters{radius}));
            CHECK_FALSE(scene.passable({0, middle}, {1, middle}, Meters{radius + 1e-8}));
        }
}

TEST_CASE(
    "passable: the answer agrees with distances to the nearest wall, sampled along the segment") {
    const Scene scene(drawn_map({".......", "..##...", "..##...", "......."}));
    test::Draw draw(8);
    constexpr double walked_error = 3e-3;  // spacing of the walk over half a metre of distance
    for (int i = 0; i < 400; ++i) {
        const Vec3 a{draw.uniform(-2, 9), draw.uniform(-2, 6), 0};
        const Vec3 b{draw.uniform(-2, 9), draw.uniform(-2, 6), 0};
        const double distance = walked_distance(a, b, 2, 1, 4, 3);
        const double radius = draw.uniform(0.01, 2);
        if (std::abs(distance - radius) < walked_error) continue;
        REQUIRE(scene.passable(a, b, Meters{radius}) == (distance > radius));
        REQUIRE(scene.passable(b, a, Meters{radius}) == (distance > radius));
    }
}

TEST_CASE("passable: on a large map no obstacle near the path is missed") {
    test::Draw draw(9);
    for (int trial = 0; trial < 20; ++trial) {
        const Scene scene(test::random_map(draw, 130, 100, 0));
        for (int i = 0; i < 100; ++i) {
            const Vec3 a{draw.uniform(-9, 140), draw.uniform(-9, 110), 0};
            const Vec3 b{draw.uniform(-9, 140), draw.uniform(-9, 110), 0};
            const double radius = draw.uniform(0.1, 12);
            double nearest = std::numeric_limits<double>::infinity();
            for (const auto& [corners, material, bottom, top] : scene.wall_rectangles()) {
                const Vec3 low = corners[0], high = corners[2];
                nearest = std::min(nearest, walked_distance(a, b, low.x, low.y, high.x, high.y));
            }
            constexpr double walked_error = 0.1;  // spacing of the walk: 0.08 m
            if (std::abs(nearest - radius) < walked_error || nearest < walked_error) continue;
            REQUIRE(scene.passable(a, b, Meters{radius}) == (nearest > radius));
        }
    }
}

TEST_CASE("scene: bounds and wall rectangles are in metres, in world coordinates") {
    OccupancyGrid grid = drawn_map({"..", "##"}, 0.5);
    grid.origin = {10, 20, 0};
    const Scene scene(grid);
    CHECK(scene.lower_left() == Vec3{10, 20, 0});
    CHECK(scene.upper_right() == Vec3{11, 21, 0});
    CHECK(scene.occupied_cells() == 2);
    REQUIRE(scene.wall_rectangles().size() == 1);
    CHECK(scene.wall_rectangles()[0].corners[0] == Vec3{10, 20, 0});
    CHECK(scene.wall_rectangles()[0].corners[1] == Vec3{11, 20, 0});
    CHECK(scene.wall_rectangles()[0].corners[2] == Vec3{11, 20.5, 0});
    CHECK(scene.wall_rectangles()[0].corners[3] == Vec3{10, 20.5, 0});
    grid.yaw = pi / 2;
    const Scene turned(grid);
    CHECK(near(turned.lower_left().x, 9));
    CHECK(near(turned.upper_right().y, 21));
}

}  // namespace scene_test
