// SPDX-License-Identifier: MIT
// Losses between the storeys of a scene: what ceilings and models say of floors.
#include "models/propagation/floors_between.hpp"

#include "models/propagation/friis.hpp"
#include "models/propagation/itu_indoor.hpp"
#include "models/propagation/itu_site_general.hpp"
#include "models/propagation/log_distance.hpp"
#include "models/propagation/multi_wall.hpp"
#include "models/propagation/propagation.hpp"
#include "models/propagation/rays.hpp"
#include "models/propagation/raytrace_2007.hpp"
#include "scene/scene.hpp"
#include "test/models/vectors.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace floors_between_test {
using namespace rovernet;
using test::near;

namespace {

constexpr double tolerance = 1e-9;  // [dB]
constexpr double cell = 0.05;       // [m]

/// A strip of free cells along x with walls right across it: where they begin, and how many cells
/// thick they are.
OccupancyGrid strip(double length, const std::vector<std::pair<int, int>>& walls, double height) {
    OccupancyGrid grid;
    grid.columns = static_cast<int>(length / cell) + 1;
    grid.rows = 8;
    grid.cell_width = grid.cell_height = cell;
    grid.origin.z = height;
    grid.cells.assign(static_cast<std::size_t>(grid.columns * grid.rows), Cell::free);
    for (const auto& [begin, thick] : walls)
        for (int row = 0; row < grid.rows; ++row)
            for (int column = begin; column < begin + thick; ++column)
                grid.cells[static_cast<std::size_t>(row * grid.columns + column)] = Cell::occupied;
    return grid;
}

/// Storeys of 3 m without walls.
Scene empty_storeys(std::size_t number, std::vector<Material> ceilings = {}) {
    std::vector<OccupancyGrid> maps;
    for (std::size_t i = 0; i < number; ++i)
        maps.push_back(strip(10, {}, 3 * static_cast<double>(i)));
    return Scene(std::move(maps), {Material{}}, std::move(ceilings));
}

/// Loss between heights, 8 m apart in plan.
double loss(const Propagation& model, const Scene& scene, double z0, double z1,
            Hertz f = 2450_MHz) {
    return test::OneLink{.frequency = f, .from = {1, 0.2, z0}, .to = {9, 0.2, z1}, .scene = &scene}
        .loss(model);
}

const Material slab_15{.name = "slab", .per_crossing = 15_dB};
const Material concrete{.name = "concrete", .slab = ItuMaterial::concrete, .thickness = {0.2}};

}  // namespace

TEST_CASE("storeys: without a storey height no floors are counted, at any antenna height") {
    const auto loss_at = [](const Propagation& model, double height, Hertz f, Meters storey) {
        const Vec3 to{25, 0, height};
        const std::uint64_t key = 2;
        const Scene field;
        LinkBatch link{.frequency = f,
                       .from = {0, 0, 1},
                       .to = {&to, 1},
                       .from_key = 1,
                       .to_keys = {&key, 1},
                       .scene = &field};
        if (storey != no_storeys) link.floor_height = storey;
        double out = 0;
        model.loss(link, {test::no_cutoff}, {&out, 1});
        return out;
    };
    const ItuIndoor office{.environment = Environment::office};
    for (const Propagation& model : {Propagation(MultiWall{}), Propagation(office)})
        for (const Hertz f : {2450_MHz, 5000_MHz}) {
            const double slope = 3e-3;  // [dB] of a centimetre in height
            const auto at = [&](double height, Meters storey) {
                return loss_at(model, height, f, storey);
            };
            CHECK(near(at(2.99, no_storeys), at(3, no_storeys), slope));
            CHECK(near(at(5.99, no_storeys), at(6, no_storeys), slope));
            CHECK(near(at(-0.01, no_storeys), at(0, no_storeys), slope));
            CHECK(at(3, Meters{3}) - at(2.99, Meters{3}) > 10);  // where a file asks for storeys
        }
}

TEST_CASE("storeys: losses of the model `multi_wall` between storeys equal those of COST 231") {
    const test::Vectors vectors("cost231_multiwall.csv");
    constexpr int light = 1, heavy = 4, apart = 8;  // [cells]: 5 cm, 20 cm
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const double d = vectors.number(i, "d_m");
        const auto floors = static_cast<int>(vectors.number(i, "k_floors"));
        // The walls stand in all storeys in turn, as the link is in the lowest, ... the highest.
        constexpr double height = 0.01;  // [m] of a storey: the antennas stay near the same height
        std::vector<std::vector<std::pair<int, int>>> walls(static_cast<std::size_t>(floors) + 1);
        int at = 4;
        const auto build = [&](const char* column, int thick) {
            for (int k = 0; k < static_cast<int>(vectors.number(i, column)); ++k, at += apart) {
                const double share = (at + thick / 2.0) * cell / d;
                const double z = height / 2 + share * height * floors;
                walls[static_cast<std::size_t>(z / height)].emplace_back(at, thick);
            }
        };
        build("k_light", light);
        build("k_heavy", heavy);
        std::vector<OccupancyGrid> maps;
        for (std::size_t k = 0; k < walls.size(); ++k)
            maps.push_back(strip(d, walls[k], height * static_cast<double>(k)));
        const Scene scene(maps, {Material{}});
        const double rise = height * floors;
        const double run = std::sqrt(d * d - rise * rise);
        const test::OneLink link{.frequency = {vectors.number(i, "f_MHz") * 1e6},
                                 .from = {0.01, 0.2, height / 2},
                                 .to = {0.01 + run, 0.2, height / 2 + rise},
                                 .scene = &scene};
        CAPTURE(d);
        CAPTURE(floors);
        CHECK(
            near(link.loss(MultiWall{}), vectors.number(i, "L_dB(Lc=0)"), test::vector_tolerance));
    }
}

TEST_CASE(
    "storeys: a ceiling costs the loss of its material or else that of the model, never both") {
    const MultiWall model{};
    const auto more = [&](const std::vector<Material>& ceilings) {
        const Scene scene = empty_storeys(ceilings.size() + 1, ceilings);
        const double top = 3 * static_cast<double>(ceilings.size()) + 1;
        CHECK(loss(model, scene, 1, top) == loss(model, scene, top, 1));
        return loss(model, scene, 1, top) - loss(model, Scene{}, 1, 1) -
               20 * std::log10(std::sqrt(64 + (top - 1) * (top - 1)) / 8);
    };
    const Material by_model{};
    CHECK(near(more({by_model}), 18.3, tolerance));
    CHECK(near(more({slab_15}), 15, tolerance));
    CHECK(near(more({slab_15, slab_15}), 30, tolerance));
    // Two floors of COST 231: 18.3 * 2^(4/3 - 0.46).
    CHECK(near(more({by_model, by_model}), 33.5235976238911, 1e-9));
    CHECK(near(more({by_model, slab_15, by_model}), 33.5235976238911 + 15, 1e-9));
    CHECK(near(more({concrete}), slab_loss(ItuMaterial::concrete, {0.2}, 2450_MHz).value, 1e-9));
}

TEST_CASE("storeys: there are no ceilings below the lowest floor and above the highest") {
    const Scene scene = empty_storeys(2, {slab_15});
    const auto floors = [&](double z0, double z1) {
        const Vec3 to{9, 0.2, z1};
        const LinkBatch link{.frequency = 2450_MHz,
                             .from = {1, 0.2, z0},
                             .to = {&to, 1},
                             .to_keys = {},
                             .scene = &scene};
        return FloorCounter(link).between(0);
    };
    CHECK(floors(-50, 2.99).loss_db == 0);
    CHECK(floors(3, 50).loss_db == 0);
    CHECK(floors(-50, 50).loss_db == 15);
    CHECK(floors(-50, 50).of_model == 0);
}

TEST_CASE(
    "storeys: `itu_indoor` counts ceilings only if given an environment but no number of floors") {
    const ItuIndoor office{.environment = Environment::office};
    const Hertz f = 1900_MHz;
    const double d = std::sqrt(64 + 36.0);
    const double without = itu_indoor_db(d, f, 30, 0);
    CHECK(near(loss(office, empty_storeys(3), 1, 7, f), without + 19, tolerance));
    CHECK(
        near(loss(office, empty_storeys(3, {slab_15, {}}), 1, 7, f), without + 15 + 15, tolerance));
    CHECK(
        near(loss(office, empty_storeys(3, {slab_15, slab_15}), 1, 7, f), without + 30, tolerance));
    // Given floors and a bare coefficient leave the scene's ceilings out.
    const ItuIndoor given{.environment = Environment::office, .floors = 1};
    CHECK(near(loss(given, empty_storeys(3, {slab_15, {}}), 1, 7, f), without + 15, tolerance));
    CHECK(near(loss(ItuIndoor{}, empty_storeys(3, {slab_15, {}}), 1, 7, f), without, tolerance));
}

TEST_CASE("storeys: `raytrace_2007` adds the loss of a ceiling only if its material has a loss") {
    const Raytrace2007 model{.coefficient = 20};
    const double without = loss(model, Scene{}, 1, 4);
    CHECK(near(loss(model, empty_storeys(2), 1, 4), without, tolerance));
    CHECK(near(loss(model, empty_storeys(2, {slab_15}), 1, 4), without + 15, tolerance));
    const Scene walls({strip(10, {{80, 4}}, 0), strip(10, {}, 3)}, {Material{}}, {slab_15});
    // From x = 1 to 9 it passes the ceiling at x = 6.33; the wall is below, 0.2 m in plan.
    const double slope = std::sqrt(64 + 9.0) / 8;
    CHECK(near(loss(model, walls, 1, 4), without + 15 + 100 * 0.2 * slope, tolerance));
}

TEST_CASE("storeys: models that ignore walls also ignore ceilings") {
    const Scene scene = empty_storeys(2, {slab_15});
    CHECK(loss(Friis{}, scene, 1, 4) == loss(Friis{}, Scene{}, 1, 4));
    CHECK(loss(LogDistance{}, scene, 1, 4) == loss(LogDistance{}, Scene{}, 1, 4));
}

TEST_CASE("storeys: for the model `itu_site_general`, a ceiling blocks the line of sight") {
    const ItuSiteGeneral office{}, blocked{.los = LineOfSight::no};
    const Scene scene = empty_storeys(2);
    CHECK(loss(office, scene, 1, 2) < loss(blocked, scene, 1, 2));
    CHECK(loss(office, scene, 1, 4) == loss(blocked, scene, 1, 4));
}

TEST_CASE("storeys: the model `rays` refuses a scene with several storeys") {
    CHECK_NOTHROW(Propagation(Rays{}).check_scene(empty_storeys(1)));
    CHECK_THROWS_AS(Propagation(Rays{}).check_scene(empty_storeys(2)), std::invalid_argument);
    CHECK_NOTHROW(Propagation(MultiWall{}).check_scene(empty_storeys(2)));
}

}  // namespace floors_between_test
