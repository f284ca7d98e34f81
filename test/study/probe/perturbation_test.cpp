// SPDX-License-Identifier: MIT
#include "study/probe/perturbation.hpp"

#include "models/propagation/raytrace_2007.hpp"
#include "scene/scene.hpp"
#include "study/probe/displaced.hpp"
#include "test/models/vectors.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace perturbation_test {
using namespace rovernet;
using test::drawn_map;
using test::near;

namespace {

constexpr double rounding = 1e-9;  // [dB]

const std::vector<std::string> hall = {"..........",  //
                                       "..#.###.#.",  //
                                       "..#.###.#.",  //
                                       "..#.###.#.",  //
                                       "..........",  //
                                       ".........."};

/// A scenario in a hall whose walls are of material `number`.
Scenario in_hall(std::vector<Material> materials, std::uint8_t number, PropagationTable model) {
    OccupancyGrid map = drawn_map(hall, 0.5);
    map.material = number;
    Scenario scenario;
    scenario.propagation = std::move(model);
    scenario.walls = std::make_shared<const Scene>(std::move(map), std::move(materials));
    return scenario;
}

template <class Model>
PropagationTable table_of(const Model& model) {
    PropagationTable table;
    std::size_t index = 0;
    for_each_model([&]<class Each>() {
        if (Each::name == Model::name) table.model = index;
        ++index;
    });
    std::get<Model>(table.parameters) = model;
    return table;
}

double loss(const Propagation& model, const Scene& scene, Vec3 from, Vec3 to,
            std::uint64_t from_key = 1, std::uint64_t to_key = 2) {
    const LinkBatch batch{.frequency = Radio{}.frequency,
                          .from = from,
                          .to = {&to, 1},
                          .from_key = from_key,
                          .to_keys = {&to_key, 1},
                          .scene = &scene};
    double out = 0;
    model.loss(batch, Db{std::numeric_limits<double>::infinity()}, {&out, 1});
    return out;
}

double loss(const Perturbation& p, Vec3 from, Vec3 to) {
    return loss(p.settings().propagation, *p.settings().scene, from, to);
}

const Perturbation& named(const std::vector<Perturbation>& all, const std::string& name) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Perturbation& p) { return p.name == name; });
    REQUIRE(found != all.end());
    return *found;
}

std::vector<std::string> names(const std::vector<Perturbation>& all) {
    std::vector<std::string> out;
    for (const Perturbation& p : all) out.push_back(p.name);
    return out;
}

const Vec3 left{0.25, 1.75}, right{1.75, 1.75}, far_right{4.75, 1.75};

}  // namespace

TEST_CASE("perturbations: on an open field, or with models without walls, only positions change") {
    const std::vector<std::string> places{"1 cm", "1 um"};
    CHECK(names(perturbations(Scenario{})) == places);
    CHECK(names(perturbations(in_hall({Material{}}, 0, table_of(Friis{})))) == places);
}

TEST_CASE(
    "perturbations: walls are varied also if only the propagation model of a single robot uses "
    "walls") {
    Scenario scenario = in_hall({Material{}}, 0, table_of(Friis{}));
    scenario.robots.emplace_back().propagation = table_of(Raytrace2007{});
    CHECK(perturbations(scenario).size() > 2);
}

TEST_CASE(
    "perturbations: dividing the cells of a map does not change losses; joining cells makes walls "
    "thicker") {
    const Scenario scenario = in_hall({Material{}}, 0, table_of(Raytrace2007{.wall_factor = 0.1}));
    const auto all = perturbations(scenario);
    const double given =
        loss(scenario.propagation.make(), *scenario.walls, left, right);  // 0.5 m of wall
    CHECK(near(loss(named(all, "resolution x2"), left, right), given, rounding));
    CHECK(near(loss(named(all, "resolution x0.5"), left, right), given + 2.5, rounding));
}

TEST_CASE("perturbations: outlining a wall keeps only its outer cells") {
    const Scenario scenario = in_hall({Material{}}, 0, table_of(Raytrace2007{.wall_factor = 0.1}));
    const auto all = perturbations(scenario);
    const double given = loss(scenario.propagation.make(), *scenario.walls, left, far_right);
    CHECK(near(loss(named(all, "walls outlined"), left, far_right), given - 5, rounding));
    CHECK(named(all, "walls filled").nothing == "no wall is hollow");
}

TEST_CASE("perturbations: walls that are changed for radio do not change where robots can move") {
    const Scenario scenario = in_hall({Material{}}, 0, table_of(Raytrace2007{}));
    const auto all = perturbations(scenario);
    const auto scene = named(all, "resolution x0.5").settings().scene;
    CHECK(scene->passable({1.75, 0.5}, {1.75, 2.75}, Meters{0.2}));
    CHECK(scene->occupied({1.75, 1.75}));
}

TEST_CASE(
    "perturbations: the loss of a wall is raised and lowered by 3 dB, for every kind of material") {
    struct Kind {
        const char* what;
        Material material;
    };
    const Kind kinds[] = {
        {"a loss per crossing", {.name = "wall", .per_crossing = Db{10}}},
        {"a loss per metre", {.name = "wall", .per_metre = DbPerMeter{20}}},
        {"both", {.name = "wall", .per_crossing = Db{4}, .per_metre = DbPerMeter{20}}},
        {"concrete", {.name = "wall", .slab = ItuMaterial::concrete, .thickness = Meters{0.2}}},
        {"glass", {.name = "wall", .slab = ItuMaterial::glass, .thickness = Meters{0.02}}},
        {"metal", {.name = "wall", .slab = ItuMaterial::metal, .thickness = Meters{1e-5}}},
    };
    for (const Kind& kind : kinds) {
        CAPTURE(kind.what);
        const Scenario scenario = in_hall({Material{}, kind.material}, 1, table_of(MultiWall{}));
        const double given = loss(scenario.propagation.make(), *scenario.walls, left, right);
        const auto all = perturbations(scenario);
        CHECK(near(loss(named(all, "wall +3 dB"), left, right), given + 3, 1e-6));
        if (kind.material.slab == ItuMaterial::glass) continue;  // takes less than 3 dB
        CHECK(near(loss(named(all, "wall -3 dB"), left, right), given - 3, 1e-6));
    }
}

TEST_CASE("perturbations: if 3 dB are taken from a wall of 1 dB, its loss is 0 and not negative") {
    const Material paper{.name = "paper", .per_crossing = Db{1}};
    const Scenario scenario = in_hall({Material{}, paper}, 1, table_of(MultiWall{}));
    const double free = loss(MultiWall{}, Scene{}, left, right);
    CHECK(near(loss(named(perturbations(scenario), "paper -3 dB"), left, right), free, rounding));
}

TEST_CASE(
    "perturbations: for walls without a material, the model's parameter for walls is changed") {
    for (const PropagationTable& model :
         {table_of(MultiWall{}), table_of(Raytrace2007{.wall_factor = 0.1})}) {
        CAPTURE(model.make().name());
        const Scenario scenario = in_hall({Material{}}, 0, model);
        const double given = loss(model.make(), *scenario.walls, left, right);
        const auto all = perturbations(scenario);
        CHECK(near(loss(named(all, "walls +3 dB"), left, right), given + 3, rounding));
        CHECK(near(loss(named(all, "walls -3 dB"), left, right), given - 3, rounding));
    }
}

TEST_CASE("perturbations: a model without a parameter for walls is reported") {
    const Scenario scenario =
        in_hall({Material{}}, 0, table_of(ItuSiteGeneral{.los = LineOfSight::map}));
    CHECK_FALSE(named(perturbations(scenario), "walls +3 dB").nothing.empty());
}

TEST_CASE("perturbations: if there are more than eight materials, all are changed together") {
    std::vector<Material> materials{Material{}};
    OccupancyGrid map = drawn_map({"#.#.#.#.#.#.#.#.#."});
    for (int i = 0; i < map.columns; ++i) {
        map.cell_materials.push_back(static_cast<std::uint8_t>(1 + i / 2));
        materials.push_back(
            {.name = std::string(1, static_cast<char>('a' + i)), .per_crossing = Db{5}});
    }
    Scenario scenario = in_hall({Material{}}, 0, table_of(MultiWall{}));
    scenario.walls = std::make_shared<const Scene>(std::move(map), std::move(materials));
    const auto all = perturbations(scenario);
    const Vec3 a{-1, 0.5}, b{19, 0.5};
    const double given = loss(scenario.propagation.make(), *scenario.walls, a, b);
    CHECK(near(loss(named(all, "all materials +3 dB"), a, b), given + 27, rounding));
}

TEST_CASE(
    "displaced antennas: each antenna moves by the given distance, in a direction set by the "
    "robot's key") {
    const Displaced model{Friis{}, Meters{0.01}};
    const Vec3 at{3, 4};
    for (std::uint64_t key = 0; key < 100; ++key) {
        CHECK(near(distance(Vec3{}, model.displacement(key)), 0.01, 1e-15));
    }
    for (std::uint64_t key = 0; key < 20; ++key) {
        const Vec3 from = model.displacement(key), to = at + model.displacement(key + 1);
        const double there = loss(model, Scene{}, {}, at, key, key + 1);
        CHECK(there == loss(Friis{}, Scene{}, from, to));
        CHECK(there == loss(model, Scene{}, at, {}, key + 1, key));
    }
}

TEST_CASE(
    "displaced antennas: over many robots, each of four directions occurs about equally often") {
    const Displaced model{Friis{}, Meters{1}};
    int east = 0, north = 0;
    constexpr int n = 4000;
    for (std::uint64_t key = 0; key < n; ++key) {
        east += model.displacement(key) == Vec3{1, 0};
        north += model.displacement(key) == Vec3{0, 1};
    }
    CHECK(std::abs(east - n / 4) < 150);  // 5 sigma are 137
    CHECK(std::abs(north - n / 4) < 150);
}

TEST_CASE("displaced antennas: beyond the reach of the model, losses are above the link budget") {
    const Displaced model{Friis{}, Meters{0.5}};
    const Hertz frequency = Radio{}.frequency;
    const double reach = model.reach(Db{70}, frequency, Propagation::anything).value;
    for (std::uint64_t key = 0; key < 100; ++key) {
        CHECK(loss(model, Scene{}, {}, {reach * (1 + 1e-9), 0}, key, key + 1) > 70);
    }
}

}  // namespace perturbation_test
