// SPDX-License-Identifier: MIT
#include "mobility/planner.hpp"

#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace planner_test {
using namespace rovernet;
using test::drawn_map;

namespace {

using Path = std::vector<Vec3>;

double length_of(const Path& path) {
    double sum = 0;
    for (std::size_t i = 1; i < path.size(); ++i) sum += distance(path[i - 1], path[i]);
    return sum;
}

bool passable(const Scene& scene, const Path& path, Meters radius) {
    for (std::size_t i = 1; i < path.size(); ++i)
        if (!scene.passable(path[i - 1], path[i], radius)) return false;
    return true;
}

/// Cells reachable by a point robot, by flooding over cell sides: the oracle for "there is a way".
std::vector<bool> flooded(const OccupancyGrid& grid, int column, int row) {
    std::vector<bool> seen(grid.cells.size());
    std::vector<std::pair<int, int>> todo{{column, row}};
    while (!todo.empty()) {
        const auto [i, j] = todo.back();
        todo.pop_back();
        if (i < 0 || i >= grid.columns || j < 0 || j >= grid.rows) continue;
        const auto cell = static_cast<std::size_t>(j * grid.columns + i);
        if (seen[cell] || grid.cells[cell] != Cell::free) continue;
        seen[cell] = true;
        for (const auto& [u, v] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
            todo.emplace_back(i + u, j + v);
    }
    return seen;
}

}  // namespace

TEST_CASE("planner: on an open field the path is the straight line") {
    const Scene field;
    const auto path = Planner(field, 0.3_m).shortest_path({0, 0, 1}, {500, -20, 2});
    REQUIRE(path);
    CHECK(*path == Path{{0, 0, 1}, {500, -20, 2}});
}

TEST_CASE("planner: the straight line is used where it is passable") {
    const Scene scene(drawn_map({".....", "..#..", "....."}));
    const auto path = shortest_path(scene, {0.5, 0.5}, {4.5, 0.5}, 0.4_m);
    REQUIRE(path);
    CHECK(*path == Path{{0.5, 0.5}, {4.5, 0.5}});
}

TEST_CASE(
    "planner: a robot too wide for a door takes a detour; if there is none, no path is found") {
    const auto map = drawn_map(
        {
            "............",
            "............",
            "......##....",
            "......##....",
            "......##....",
            "............",
            "......##....",
            "......##....",
        },
        0.5);
    const Scene scene(map);
    const Vec3 from{1, 1.25}, to{5, 1.25};
    const auto slim = shortest_path(scene, from, to, 0.25_m);  // the door is 0.5 m wide
    REQUIRE(slim);
    CHECK(passable(scene, *slim, 0.25_m));
    CHECK(length_of(*slim) < 4.1);
    const auto wide = shortest_path(scene, from, to, 0.26_m);
    REQUIRE(wide);
    CHECK(passable(scene, *wide, 0.26_m));
    CHECK(length_of(*wide) > 6);
    CHECK_FALSE(shortest_path(Scene(drawn_map({"..#..", ".....", "..#.."}, 0.5)), {0.25, 0.75},
                              {2.25, 0.75}, 0.3_m));
}

TEST_CASE("planner: there is no path into a wall, off the map or into a closed room") {
    const Scene scene(drawn_map({
        ".......",
        ".#####.",
        ".#...#.",
        ".#.?.#.",
        ".#...#.",
        ".#####.",
        ".......",
    }));
    Planner planner(scene, 0.2_m);
    CHECK_FALSE(planner.shortest_path({0.5, 0.5}, {1.5, 1.5}));  // in a wall
    CHECK_FALSE(planner.shortest_path({2.5, 2.5}, {3.5, 3.5}));  // in the unknown
    CHECK_FALSE(planner.shortest_path({0.5, 0.5}, {2.5, 2.5}));  // a closed room
    CHECK_FALSE(planner.shortest_path({2.5, 2.5}, {0.5, 0.5}));  // out of it
    CHECK_FALSE(planner.shortest_path({0.5, 0.5}, {-0.5, 0.5}));
    CHECK_FALSE(planner.shortest_path({0.5, 99}, {0.5, 0.5}));
    CHECK_FALSE(planner.shortest_path({0.5, 0.5}, {0.9, 1.5}));  // too near to a wall
    CHECK(planner.shortest_path({0.5, 0.5}, {6.5, 6.5}));
    CHECK(planner.shortest_path({2.5, 2.5}, {4.5, 4.5}));
}

TEST_CASE(
    "planner: if walls stand on open ground, a path may start, lead and end outside the grid of "
    "the walls") {
    // A pillar of one cell, and a corridor that is open on the right only.
    for (const auto& rows :
         {std::vector<std::string>{"#"}, std::vector<std::string>{"######", "......", "######"}}) {
        for (const double radius : {0.0, 0.3, 2.0, 40.0}) {
            OccupancyGrid grid = drawn_map(rows);
            grid.open_ground = true;
            const Scene scene(grid);
            Planner planner(scene, Meters{radius});
            const double reach = radius + 0.5;
            const Vec3 left{-reach, 0.5}, right{grid.columns + reach, 0.5};
            const Vec3 above{3, grid.rows + reach}, far{-1e7, -2e7};
            for (const auto& [from, to] : {std::pair{left, right},
                                           {right, left},
                                           {above, far},
                                           {far, right},
                                           {left, Vec3{1e6, 0.5}}}) {
                const auto path = planner.shortest_path(from, to);
                CAPTURE(radius);
                REQUIRE(path);
                CHECK(planner.has_way(from, to));
                CHECK(path->front() == from);
                CHECK(path->back() == to);
                CHECK(passable(scene, *path, Meters{radius}));
                // No farther than around the circle that encloses the walls.
                const double size = grid.columns + grid.rows + 2 * reach;
                CHECK(length_of(*path) < distance(from, to) + 4 * size);
            }
        }
    }
}

TEST_CASE("planner: from open ground there is a path into a room exactly if the room has a door") {
    for (const bool has_door : {false, true}) {
        OccupancyGrid grid =
            drawn_map({"#####", "#...#", has_door ? "#...." : "#...#", "#...#", "#####"});
        grid.open_ground = true;
        const Scene scene(grid);
        Planner planner(scene, 0.4_m);
        for (const Vec3 outside : {Vec3{-3, 2.5}, Vec3{-0.5, -0.5}, Vec3{900, -1e5}}) {
            CHECK(planner.has_way(outside, {2.5, 2.5}) == has_door);
            const auto path = planner.shortest_path({2.5, 2.5}, outside);
            REQUIRE(path.has_value() == has_door);
            if (path) CHECK(passable(scene, *path, 0.4_m));
        }
        CHECK(planner.shortest_path({2.5, 2.5}, {1.5, 1.5}));
        CHECK_FALSE(planner.shortest_path({-3, 2.5}, {-0.3, 2.5}));  // too near to the wall
    }
}

TEST_CASE(
    "planner: inside closed walls, paths are the same whether or not robots may leave the map") {
    test::Draw draw(32);
    for (int trial = 0; trial < 20; ++trial) {
        OccupancyGrid grid = test::random_map(draw, 30, 20, 20);
        for (int i = 0; i < 600; ++i) {
            const int column = i % 30, row = i / 30;
            const bool is_edge = column % 29 == 0 || row % 19 == 0;
            if (is_edge) grid.cells[static_cast<std::size_t>(i)] = Cell::occupied;
        }
        const Scene bordered(grid);
        grid.open_ground = true;
        const Scene open(grid);
        Planner one(bordered, 0.35_m), other(open, 0.35_m);
        for (int i = 0; i < 30; ++i) {
            const Vec3 from{draw.uniform(0, 30), draw.uniform(0, 20)};
            const Vec3 to{draw.uniform(0, 30), draw.uniform(0, 20)};
            CHECK(one.shortest_path(from, to) == other.shortest_path(from, to));
        }
    }
}

TEST_CASE("planner: no path passes between two walls that touch at a corner") {
    const Scene scene(drawn_map({".#", "#."}));
    CHECK_FALSE(shortest_path(scene, {0.2, 1.7}, {1.6, 0.5}, 0_m));
}

TEST_CASE(
    "planner: a path is found exactly where a flood fill finds one, and the robot fits along it") {
    test::Draw draw(31);
    for (int trial = 0; trial < 40; ++trial) {
        const OccupancyGrid grid = test::random_map(draw, 30, 20, 20 + draw.below(20));
        const Scene scene(grid);
        Planner planner(scene, Meters{0.4});
        for (int i = 0; i < 20; ++i) {
            const int column = draw.below(30), row = draw.below(20);
            const int goal_column = draw.below(30), goal_row = draw.below(20);
            const Vec3 from{column + 0.5, row + 0.5}, to{goal_column + 0.5, goal_row + 0.5};
            const bool expected = flooded(
                grid, column, row)[static_cast<std::size_t>(goal_row * grid.columns + goal_column)];
            const auto path = planner.shortest_path(from, to);
            REQUIRE(path.has_value() == expected);
            if (!path) continue;
            REQUIRE(path->front() == from);
            REQUIRE(path->back() == to);
            REQUIRE(passable(scene, *path, 0.4_m));
        }
    }
}

TEST_CASE(
    "planner: around the end of a wall the path is less than 1 % longer than the shortest one") {
    // A wall from the lower edge to y = 6 m, from x = 9.6 m to 10.6 m. The string goes round its
    // upper corners at the distance of the radius: a straight part and an arc on either side.
    std::vector<std::string> rows(40, std::string(100, '.'));
    for (std::size_t i = 10; i < 40; ++i) rows[i].replace(48, 5, "#####");
    const Scene scene(drawn_map(rows, 0.2));
    const double radius = 0.5;
    const auto side = [&](double dx, double dy) {  // from an end to above the corner
        const double d = std::sqrt(dx * dx + dy * dy);
        const double arc = std::atan2(dy, dx) + std::asin(radius / d);
        return std::sqrt(d * d - radius * radius) + radius * arc;
    };
    double longest = 0;
    for (int left = 0; left < 6; ++left)
        for (int right = 0; right < 6; ++right) {
            const Vec3 from{1.5 + left, 1.0 + 0.7 * left}, to{18.7 - right, 0.6 + 0.8 * right};
            const double taut = side(9.6 - from.x, 6 - from.y) + 1 + side(to.x - 10.6, 6 - to.y);
            const auto path = shortest_path(scene, from, to, Meters{radius});
            REQUIRE(path);
            REQUIRE(passable(scene, *path, Meters{radius}));
            REQUIRE(length_of(*path) > taut - 1e-6);
            longest = std::max(longest, length_of(*path) / taut);
        }
    // Corners stand a fraction of a cell off the string; pulled from one end only, it is 1.026.
    CHECK(longest < 1.01);
}

TEST_CASE("planner: a path may start in a narrow corridor in which no cell centre is free") {
    // The corridor is 2 m wide and its middle is a grid line: no cell centre in it is free.
    const Scene scene(drawn_map({
        "......",
        "####..",
        "......",
        "......",
        "####..",
        "......",
    }));
    Planner planner(scene, 0.8_m);
    const auto path = planner.shortest_path({3.5, 3}, {5, 1});
    REQUIRE(path);
    CHECK(passable(scene, *path, 0.8_m));
}

TEST_CASE("planner: equal requests give equal paths to the last bit") {
    test::Draw draw(33);
    OccupancyGrid grid = test::random_map(draw, 50, 50, 10);
    grid.yaw = 0.3;
    grid.origin = {3, -2, 0};
    const Scene scene(grid);
    Planner planner(scene, 0.3_m), again(scene, 0.3_m);
    int found = 0;
    for (int i = 0; i < 50; ++i) {
        const Vec3 from = scene.frame().to_world({draw.uniform(0, 50), draw.uniform(0, 50)}, 1);
        const Vec3 to = scene.frame().to_world({draw.uniform(0, 50), draw.uniform(0, 50)}, 1);
        const auto path = planner.shortest_path(from, to);
        REQUIRE(path == again.shortest_path(from, to));
        if (!path) continue;
        ++found;
        REQUIRE(passable(scene, *path, 0.3_m));
        for (const Vec3& p : *path) REQUIRE(p.z == 1);
    }
    CHECK(found > 10);
}

TEST_CASE("planner: a radius that is negative or not a number is refused") {
    const Scene field;
    CHECK_THROWS_AS(Planner(field, Meters{-0.1}), std::invalid_argument);
    CHECK_THROWS_AS(Planner(field, Meters{std::numeric_limits<double>::quiet_NaN()}),
                    std::invalid_argument);
}

TEST_CASE("planner: has_way() is true exactly where a path is found") {
    test::Draw draw(32);
    for (const double radius : {0.0, 0.3, 0.7, 1.2}) {
        const Scene scene(test::random_map(draw, 30, 20, 12));
        Planner planner(scene, Meters{radius});
        for (int i = 0; i < 200; ++i) {
            const Vec3 from{draw.below(320) / 10.0 - 1, draw.below(220) / 10.0 - 1};
            const Vec3 to{draw.below(320) / 10.0 - 1, draw.below(220) / 10.0 - 1};
            REQUIRE(planner.has_way(from, to) == planner.shortest_path(from, to).has_value());
        }
    }
}

TEST_CASE("planner: a path that is requested again, also after many other paths, is the same") {
    test::Draw draw(33);
    const Scene scene(test::random_map(draw, 40, 30, 9));
    Planner planner(scene, 0.3_m);
    const auto place = [&] { return Vec3{draw.below(400) / 10.0, draw.below(300) / 10.0}; };
    std::vector<std::pair<Vec3, Vec3>> questions;
    for (int i = 0; i < 5000; ++i) questions.emplace_back(place(), place());  // more than are kept
    for (int round = 0; round < 2; ++round)
        for (const auto& [from, to] : questions) planner.shortest_path(from, to);
    for (std::size_t i = 0; i < questions.size(); i += 250) {
        const auto& [from, to] = questions[i];
        REQUIRE(planner.shortest_path(from, to) == shortest_path(scene, from, to, 0.3_m));
        REQUIRE(planner.shortest_path(from, to) == shortest_path(scene, from, to, 0.3_m));
    }
    Planner other(scene, 0.3_m);
    for (const double zero : {0.0, -0.0}) {  // a way begins with the very bits of the question
        const auto path = other.shortest_path({zero, 0.5}, {39.5, 29.5});
        if (path) CHECK(std::signbit(path->front().x) == std::signbit(zero));
    }
}

}  // namespace planner_test
