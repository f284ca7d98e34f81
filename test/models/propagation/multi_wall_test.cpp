// SPDX-License-Identifier: MIT
#include "models/propagation/multi_wall.hpp"

#include "models/propagation/friis.hpp"
#include "scene/scene.hpp"
#include "test/models/vectors.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace multi_wall_test {
using namespace rovernet;
using test::near;

namespace {

constexpr double cell = 0.05;  // [m]

/// A strip of free cells along x, `length` [m] long, with walls right across it: where they begin
/// and how many cells thick they are.
OccupancyGrid strip(double length, const std::vector<std::pair<int, int>>& walls) {
    OccupancyGrid grid;
    grid.columns = static_cast<int>(length / cell) + 1;
    grid.rows = 8;
    grid.cell_width = grid.cell_height = cell;
    grid.cells.assign(static_cast<std::size_t>(grid.columns * grid.rows), Cell::free);
    for (const auto& [begin, thick] : walls)
        for (int row = 0; row < grid.rows; ++row)
            for (int column = begin; column < begin + thick; ++column)
                grid.cells[static_cast<std::size_t>(row * grid.columns + column)] = Cell::occupied;
    return grid;
}

double loss_through(const Scene& scene, double d, const MultiWall& model = {}, Hertz f = 2450_MHz) {
    return test::OneLink{
        .frequency = f, .from = {0.01, 0.2, 0}, .to = {0.01 + d, 0.2, 0}, .scene = &scene}
        .loss(model);
}

}  // namespace

TEST_CASE(
    "multi_wall: losses through light walls, heavy walls and floors equal those of COST 231") {
    const test::Vectors vectors("cost231_multiwall.csv");
    constexpr int light = 1, heavy = 4, apart = 8;  // [cells]: 5 cm, 20 cm
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const double d = vectors.number(i, "d_m");
        const double floors = vectors.number(i, "k_floors");
        std::vector<std::pair<int, int>> walls;
        int at = 4;
        const auto build = [&](const char* column, int thick) {
            for (int k = 0; k < static_cast<int>(vectors.number(i, column)); ++k, at += apart)
                walls.emplace_back(at, thick);
        };
        build("k_light", light);
        build("k_heavy", heavy);
        const Scene scene(strip(d, walls));
        constexpr double storey = 0.01;  // [m], so that the antennas stay near the same height
        const double rise = storey * floors;
        const Vec3 to{0.01 + std::sqrt(d * d - rise * rise), 0.2, storey / 2 + rise};
        const std::uint64_t key = 2;
        const LinkBatch link{.frequency = {vectors.number(i, "f_MHz") * 1e6},
                             .from = {0.01, 0.2, storey / 2},
                             .to = {&to, 1},
                             .from_key = 1,
                             .to_keys = {&key, 1},
                             .scene = &scene,
                             .floor_height = {storey}};
        double loss = 0;
        MultiWall{}.loss(link, {test::no_cutoff}, {&loss, 1});
        CAPTURE(d);
        CAPTURE(floors);
        CHECK(near(loss, vectors.number(i, "L_dB(Lc=0)"), test::vector_tolerance));
    }
}

TEST_CASE("multi_wall: a wall's thickness, not the ray's angle, decides if it is a light wall") {
    // 5 cm thick, the ray at up to 63 degrees to its normal: 11 cm of chord.
    const Scene scene(strip(2, {{20, 1}}));
    const auto loss = [&](Vec3 from, Vec3 to) {
        return test::OneLink{.from = from, .to = to, .scene = &scene}.loss(MultiWall{});
    };
    for (const double dy : {0.0, 0.1, 0.19}) {
        const Vec3 from{0.975, 0.2 - dy, 0}, to{1.075, 0.2 + dy, 0};
        CHECK(near(
            loss(from, to),
            MultiWall{}.light_wall.value + test::OneLink{.from = from, .to = to}.loss(MultiWall{}),
            1e-9));
    }
}

TEST_CASE("multi_wall: an oblique wall that is drawn as stair steps counts as one wall") {
    constexpr int cells = 200;
    constexpr double side = cells * cell, half_thickness = 0.075;  // [m]
    const Vec3 normal{-std::sin(0.35), std::cos(0.35), 0};
    const auto across = [&](Vec3 p) { return dot(p - Vec3{side / 2, side / 2, 0}, normal); };
    OccupancyGrid grid;
    grid.columns = grid.rows = cells;
    grid.cell_width = grid.cell_height = cell;
    for (int i = 0; i < cells * cells; ++i) {
        const Vec3 middle{(i % cells + 0.5) * cell, (i / cells + 0.5) * cell, 0};
        grid.cells.push_back(std::abs(across(middle)) < half_thickness ? Cell::occupied
                                                                       : Cell::free);
    }
    const Scene scene(grid);
    int in_parts = 0;
    for (int k = 0; k < 40; ++k) {  // from straight through to 14 degrees off the wall
        const Vec3 middle{side / 2 + 0.013 * k, side / 2, 0};
        const Vec3 along{normal.y, -normal.x, 0};
        const Vec3 ray = normal + (0.1 * k) * along;
        const Vec3 from = middle - 0.5 * ray, to = middle + 0.5 * ray;
        in_parts += scene.crossings(from, to).size() > 1;
        const double more =
            test::OneLink{.from = from, .to = to, .scene = &scene}.loss(MultiWall{}) -
            test::OneLink{.from = from, .to = to}.loss(MultiWall{});
        CAPTURE(k);
        CHECK(near(more, MultiWall{}.heavy_wall.value, 1e-9));
    }
    CHECK(in_parts > 3);
}

TEST_CASE(
    "multi_wall: a material's own loss, per crossing or metre, replaces the model's wall loss") {
    const auto through = [](Material material) {
        const Scene scene(strip(4, {{20, 4}}), {std::move(material)});
        return loss_through(scene, 3) - loss_through(Scene{}, 3);
    };
    CHECK(near(through({}), 6.9, 1e-9));
    CHECK(near(through({.per_crossing = 11_dB}), 11, 1e-9));
    CHECK(near(through({.per_metre = DbPerMeter{30}}), 6, 1e-9));
}

TEST_CASE(
    "multi_wall: without walls and with exponent 2, the loss beyond 1 m is that of free space") {
    for (const double d : {1.0, 7.0, 300.0}) {
        CHECK(near(test::loss_at(MultiWall{}, d), test::loss_at(Friis{}, d), 1e-12));
    }
    CHECK(test::loss_at(MultiWall{}, 0.1) == test::loss_at(MultiWall{}, 1));
    CHECK(near(test::loss_at(MultiWall{.exponent = 3, .excess = 4_dB}, 10),
               test::loss_at(Friis{}, 1) + 34, 1e-12));
}

}  // namespace multi_wall_test
