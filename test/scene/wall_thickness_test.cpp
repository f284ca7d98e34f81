// SPDX-License-Identifier: MIT
#include "scene/wall_thickness.hpp"

#include "scene/scene.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <thread>
#include <vector>

namespace wall_thickness_test {
using namespace rovernet;

namespace {

constexpr int side = 200;           // [cells]
constexpr double cell_side = 0.02;  // [m]

/// A map with one straight wall through its middle at an angle, drawn by the centres of its cells.
OccupancyGrid with_wall(double thickness, double angle, double cell = cell_side) {
    OccupancyGrid grid;
    grid.columns = grid.rows = side;
    grid.cell_width = grid.cell_height = cell;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const double x = (column + 0.5 - side / 2) * cell, y = (row + 0.5 - side / 2) * cell;
            const double off = std::abs(-std::sin(angle) * x + std::cos(angle) * y);
            grid.cells.push_back(off <= thickness / 2 ? Cell::occupied : Cell::free);
        }
    return grid;
}

constexpr Vec3 middle{side * cell_side / 2 + 1e-4, side* cell_side / 2 + 1e-4, 0};

}  // namespace

TEST_CASE(
    "wall thickness: for a straight wall at any angle, the error is at most the side of one cell") {
    for (const double thickness : {0.1, 0.3, 0.6}) {
        for (int degrees = 0; degrees < 180; degrees += 5) {
            CAPTURE(thickness);
            CAPTURE(degrees);
            const Scene scene(with_wall(thickness, degrees * std::numbers::pi / 180));
            CHECK(std::abs(scene.wall_thickness(middle).value - thickness) <= 1.01 * cell_side);
        }
    }
}

TEST_CASE(
    "wall thickness: a wall of 12 cm in cells of 5 cm measures at least 10 cm, at any angle") {
    for (int degrees = 0; degrees < 180; ++degrees) {
        CAPTURE(degrees);
        const double angle = degrees * std::numbers::pi / 180;
        const Scene scene(with_wall(0.12, angle, 0.05));
        double thinnest = 1;
        for (double along = -1; along < 1; along += 0.03) {
            const double x = along * std::cos(angle), y = along * std::sin(angle);
            const double found =
                scene.wall_thickness({side * 0.05 / 2 + x, side * 0.05 / 2 + y}).value;
            if (found > 0) thinnest = std::min(thinnest, found);
        }
        CHECK(thinnest >= 0.1);
        CHECK(thinnest < 0.15);
    }
}

TEST_CASE(
    "wall thickness: where a thin wall continues as a thick one, each part has its own thickness") {
    OccupancyGrid grid = with_wall(0, 0);
    const auto draw = [&](int from, int to, int cells) {
        for (int column = from; column < to; ++column)
            for (int row = 100; row < 100 + cells; ++row)
                grid.cells[static_cast<std::size_t>(row * side + column)] = Cell::occupied;
    };
    draw(20, 100, 4);
    draw(100, 180, 5);
    const Scene scene(grid);
    const double y = 100.5 * cell_side;
    for (int column = 30; column < 170; ++column) {
        CAPTURE(column);
        const double found = scene.wall_thickness({(column + 0.5) * cell_side, y}).value;
        CHECK(found == doctest::Approx(column < 100 ? 4 * cell_side : 5 * cell_side));
    }
}

TEST_CASE(
    "wall thickness: the thickness is 0 outside walls; where two walls cross, the thinner one "
    "counts") {
    OccupancyGrid grid = with_wall(0.1, 0);
    for (std::size_t i = 0; i < grid.cells.size(); ++i) {
        if (i % side >= 90 && i % side < 110) grid.cells[i] = Cell::occupied;  // 40 cm, upright
    }
    const Scene scene(grid);
    CHECK(scene.wall_thickness({0.5, 0.5}).value == 0);
    CHECK(scene.wall_thickness({-1, 2}).value == 0);
    CHECK(scene.wall_thickness({2, 0.5}).value == doctest::Approx(0.4));
    CHECK(scene.wall_thickness({0.5, 2}).value == doctest::Approx(0.12));
    CHECK(Scene{}.wall_thickness({0, 0}).value == 0);
}

TEST_CASE(
    "wall thickness: if several threads make the first request at the same time, all get the same "
    "result") {
    const Scene scene(with_wall(0.3, 0.5));
    std::vector<double> found(4);
    std::vector<std::thread> threads;
    for (double& each : found) {
        threads.emplace_back([&] { each = scene.wall_thickness(middle).value; });
    }
    for (std::thread& each : threads) each.join();
    for (const double each : found) CHECK(each == found.front());
    CHECK(found.front() > 0);
}

}  // namespace wall_thickness_test
