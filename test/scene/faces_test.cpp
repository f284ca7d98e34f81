// SPDX-License-Identifier: MIT
#include "scene/faces.hpp"

#include "scene/scene.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

namespace faces_test {
using namespace rovernet;

namespace {

constexpr double degree = std::numbers::pi / 180;

/// A wall of a length and thickness [m] in the middle of a free map, turned by an angle [rad],
/// drawn by the centres of its cells.
OccupancyGrid slanting_wall(double length, double thick, double angle, double cell = 0.05) {
    OccupancyGrid grid;
    grid.columns = grid.rows = static_cast<int>((length + 1) / cell);
    grid.cell_width = grid.cell_height = cell;
    const double c = std::cos(angle), s = std::sin(angle), middle = (length + 1) / 2;
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column) {
            const double x = (column + 0.5) * cell - middle, y = (row + 0.5) * cell - middle;
            const bool wall =
                std::abs(c * x + s * y) <= length / 2 && std::abs(c * y - s * x) <= thick / 2;
            grid.cells.push_back(wall ? Cell::occupied : Cell::free);
        }
    return grid;
}

std::vector<Face> long_faces(const Scene& scene, double longer_than) {
    std::vector<Face> found;
    for (const Face& f : scene.faces()->all())
        if (f.length > longer_than) found.push_back(f);
    return found;
}

/// Angle between two directions [rad], whichever way they point.
double between(Vec3 a, Vec3 b) { return std::asin(std::abs(a.x * b.y - a.y * b.x)); }

Vec3 direction(const Face& f) { return {-f.normal.y, f.normal.x, 0}; }

}  // namespace

TEST_CASE(
    "faces: the faces of a rectangle are exactly its four edges, also if it is one cell thick") {
    for (const int thick : {1, 2, 7}) {
        OccupancyGrid grid;
        grid.columns = 120, grid.rows = 20;
        grid.cell_width = grid.cell_height = 0.5;
        for (int row = 0; row < grid.rows; ++row)
            for (int column = 0; column < grid.columns; ++column)
                grid.cells.push_back(row >= 4 && row < 4 + thick && column >= 10 && column < 110
                                         ? Cell::occupied
                                         : Cell::free);
        const Scene scene(grid);
        const auto faces = scene.faces()->all();
        REQUIRE(faces.size() == 4);
        const double top = 2 + 0.5 * thick;
        const std::array<Vec3, 4> corners{Vec3{5, 2}, {55, 2}, {55, top}, {5, top}};
        const std::array<Vec3, 4> normals{Vec3{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
        for (std::size_t i = 0; i < 4; ++i) {
            CHECK(faces[i].from == corners[i]);
            CHECK(faces[i].to == corners[(i + 1) % 4]);
            CHECK(faces[i].normal == normals[i]);
            CHECK(faces[i].length == distance(faces[i].from, faces[i].to));
            CHECK(faces[i].deviation == 0);
        }
    }
}

TEST_CASE("faces: a wall drawn at any angle has two long faces with its angle and position") {
    constexpr double cell = 0.05, length = 6;
    for (const double thick : {0.15, 0.3}) {
        for (int degrees = 1; degrees < 90; degrees += 2) {
            CAPTURE(thick);
            CAPTURE(degrees);
            const double angle = degrees * degree;
            const Scene scene(slanting_wall(length, thick, angle, cell));
            const auto faces = long_faces(scene, 1);
            REQUIRE(faces.size() == 2);
            const Vec3 middle{(length + 1) / 2, (length + 1) / 2};
            for (const Face& f : faces) {
                CHECK(between(direction(f), {std::cos(angle), std::sin(angle)}) < 0.25 * degree);
                CHECK(f.length > length - 4 * cell);
                CHECK(f.deviation <= cell);
                CHECK(std::abs(-f.in_front(middle) - thick / 2) < 0.3 * cell);
            }
        }
    }
}

TEST_CASE("faces: a thin line whose cells touch at corners has two faces") {
    OccupancyGrid grid;
    grid.columns = grid.rows = 100;
    grid.cell_width = grid.cell_height = 0.05;
    grid.cells.assign(10'000, Cell::free);
    for (int column = 5; column < 95; ++column) {  // slope 4/10, one cell in each column
        const int row = static_cast<int>(10.5 + 0.4 * (column + 0.5));
        grid.cells[static_cast<std::size_t>(row * 100 + column)] = Cell::occupied;
    }
    const Scene scene(grid);
    const auto faces = long_faces(scene, 0.5);
    REQUIRE(faces.size() == 2);
    for (const Face& f : faces)
        CHECK(between(direction(f), {1 / std::sqrt(1.16), 0.4 / std::sqrt(1.16)}) < 0.2 * degree);
}

TEST_CASE(
    "faces: corners of rooms and doors are exact, and a bump of one cell does not split a face") {
    const Scene room(test::drawn_map({"############",  //
                                      "#..........#",  //
                                      "#..........#",  //
                                      "#..........#",  //
                                      "####....####"}));
    std::vector<Vec3> corners;
    for (const Face& f : room.faces()->all()) corners.push_back(f.from);
    const std::vector<Vec3> expected{{0, 0},  {4, 0}, {4, 1}, {1, 1},  {1, 4},  {11, 4},
                                     {11, 1}, {8, 1}, {8, 0}, {12, 0}, {12, 5}, {0, 5}};
    CHECK(corners.size() == expected.size());
    for (const Vec3 p : expected) CHECK(std::count(corners.begin(), corners.end(), p) == 1);

    OccupancyGrid bumpy = slanting_wall(6, 0.2, 0);
    for (const int column : {50, 51, 70, 90})  // above the wall's upper edge
        bumpy.cells[static_cast<std::size_t>(72 * bumpy.columns + column)] = Cell::occupied;
    const Scene scene(bumpy);
    for (const Face& f : long_faces(scene, 0.5)) {
        CHECK(f.length > 5.8);
        CHECK(between(direction(f), {1, 0}) < 0.1 * degree);
    }
    CHECK(long_faces(scene, 0.5).size() == 2);
}

TEST_CASE("faces: the faces of a wall form a closed line, with the wall's cells on its left") {
    test::Draw draw(3);
    for (int trial = 0; trial < 20; ++trial) {
        const Scene scene(test::random_map(draw, 40, 30, 10 + trial));
        const auto faces = scene.faces()->all();
        double area = 0;
        for (const Face& f : faces) {
            CHECK(std::abs(dot(f.normal, f.normal) - 1) < 1e-12);
            CHECK(f.deviation <= 1);
            area += (f.from.x * f.to.y - f.to.x * f.from.y) / 2;
        }
        const auto cells = static_cast<double>(scene.occupied_cells());
        CHECK(std::abs(area - cells) < 0.4 * cells);
    }
}

TEST_CASE("faces: a point on an edge of a drawn wall belongs to the face of this edge") {
    const Scene scene(slanting_wall(6, 0.3, 30 * degree));
    const auto faces = scene.faces()->all();
    int found = 0;
    for (const Crossing& c : scene.crossings({3.4, 0.2}, {3.6, 6.8})) {
        for (const double at : {c.entry, c.exit}) {
            const Vec3 p =
                Vec3{3.4, 0.2} + (at / distance({3.4, 0.2}, {3.6, 6.8})) * Vec3{0.2, 6.6};
            const auto face = scene.faces()->at(p, 0);
            REQUIRE(face);
            CHECK(faces[*face].length > 5);
            CHECK(std::abs(faces[*face].in_front(p)) < 0.05);
            ++found;
        }
    }
    CHECK(found == 2);
    CHECK_FALSE(scene.faces()->at({0.51, 0.52}, 0));
    CHECK_FALSE(scene.faces()->at({-3, 900}, 0));
    CHECK_FALSE(scene.faces()->at({3.5, 3.5}, 0));
}

TEST_CASE(
    "faces: a face ends where the material changes, and there is no face between two materials") {
    OccupancyGrid grid = test::drawn_map({"......", ".####.", "......"});
    grid.cell_materials.assign(grid.cells.size(), 0);
    grid.cell_materials[9] = grid.cell_materials[10] = 1;
    const Scene scene(grid, {Material{.name = "wall"}, Material{.name = "glass", .height = 2_m}});
    CHECK(scene.faces()->all().size() == 6);
    for (const Face& f : scene.faces()->all()) {
        const bool glass = std::min(f.from.x, f.to.x) >= 3;
        CHECK(f.material == (glass ? 1 : 0));
        CHECK((f.height == 2) == glass);
    }
    CHECK_FALSE(scene.faces()->at({3, 1.5}, 0));
    CHECK(scene.faces()->at({2.5, 1}, 0));
    CHECK_FALSE(scene.faces()->at({2.5, 1}, 1));
}

TEST_CASE(
    "faces: a rotated map has rotated faces, an open field has none; all threads get the same "
    "faces") {
    OccupancyGrid grid = test::drawn_map({"......", ".####.", "......"}, 0.5);
    grid.yaw = 25 * degree;
    grid.origin = {3, -4};
    const Scene scene(grid);
    std::vector<const Face*> first(4);
    std::vector<std::thread> threads;
    for (const Face*& each : first)
        threads.emplace_back([&] { each = scene.faces()->all().data(); });
    for (std::thread& each : threads) each.join();
    for (const Face* each : first) CHECK(each == first.front());
    REQUIRE(scene.faces()->all().size() == 4);
    CHECK(between(direction(*first[0]), {std::cos(grid.yaw), std::sin(grid.yaw)}) < 1e-12);
    CHECK(distance(first[0]->from, scene.frame().to_world({1, 1})) < 1e-12);
    CHECK(Scene{}.faces() == nullptr);
}

TEST_CASE("faces: each face has the thickness of its wall, at any angle and beside a junction") {
    for (int degrees = 0; degrees < 90; degrees += 5) {
        CAPTURE(degrees);
        const Scene scene(slanting_wall(6, 0.3, degrees * degree));
        for (const Face& f : long_faces(scene, 1)) CHECK(std::abs(f.thickness - 0.3) < 0.03);
    }
    const Scene junction(test::drawn_map({"....#....", "....#....", "#########"}));
    for (const Face& f : junction.faces()->all())
        if (f.length > 3) CHECK(f.thickness == 1);
}

}  // namespace faces_test
