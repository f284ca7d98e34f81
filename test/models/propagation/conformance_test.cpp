// SPDX-License-Identifier: MIT
// What every propagation model of the list keeps, whatever its equation.
#include "models/propagation/list.hpp"
#include "test/models/vectors.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace conformance_test {
using namespace rovernet;

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

template <class Model>
Model typical() {
    return {};
}
template <>
Disc typical() {
    return {.range = 40_m};
}

/// The model as it comes, and with parameters that take its other ways.
template <class Model>
std::vector<Model> variants() {
    return {typical<Model>()};
}
template <>
std::vector<LogDistance> variants() {
    return {{},
            {.sigma = 0_dB},
            {.exponent = 4, .sigma = 12_dB, .reference_distance = 10_m},
            {.exponent = 1.5, .sigma = 0_dB, .excess = -3_dB},
            {.excess = 12_dB}};
}
template <>
std::vector<TwoRay> variants() {
    return {{},
            {.form = TwoRayForm::exact},
            {.lowest_antenna = 2_m,
             .form = TwoRayForm::exact,
             .polarization = Polarization::horizontal,
             .ground_permittivity = 1}};
}
template <>
std::vector<MultiWall> variants() {
    return {{}, {.exponent = 3, .excess = -10_dB, .light_wall = 0_dB, .floor_saving = 1}};
}
template <>
std::vector<ItuSiteGeneral> variants() {
    return {{}, {.site = Site::industrial, .los = LineOfSight::no}, {.los = LineOfSight::yes}};
}
template <>
std::vector<ItuIndoor> variants() {
    ItuIndoor office, coefficient;
    office.environment = Environment::office;
    coefficient.coefficient = 20;
    return {{}, office, coefficient};
}
template <>
std::vector<Raytrace2007> variants() {
    return {{}, {.coefficient = 20, .wall_factor = 0.1}, {.wall_factor = 0}};
}

template <>
std::vector<Rays> variants() {
    return {{},
            {.order = 0, .diffraction = RayDiffraction::none},
            {.order = 1, .diffraction = RayDiffraction::utd, .max_paths = 3},
            {.order = 1, .sum = RaySum::coherent, .wall = ItuMaterial::metal},
            {.order = 1, .diffraction = RayDiffraction::utd, .sum = RaySum::coherent}};
}

/// Calls check(model) for each variant of each listed model.
template <class Check>
void for_each_variant(Check check) {
    for_each_model([&]<class Model>() {
        for (const auto& model : variants<Model>()) {
            CAPTURE(std::string(Model::name));
            check(model);
        }
    });
}

struct World {
    test::Draw draw{42};
    Scene scene{test::random_map(draw, 30, 30, 8)};
    Vec3 from = place();
    std::vector<Vec3> to{};
    std::vector<std::uint64_t> keys{};

    explicit World(int receivers = 60) {
        for (int i = 0; i < receivers; ++i) {
            to.push_back(place());
            keys.push_back(static_cast<std::uint64_t>(1000 + i));
        }
    }
    Vec3 place() { return {draw.uniform(-5, 35), draw.uniform(-5, 35), draw.uniform(-4, 8)}; }
    LinkBatch batch(Hertz f = {2450e6}) const {
        return {.frequency = f,
                .from = from,
                .to = to,
                .from_key = 7,
                .to_keys = keys,
                .scene = &scene,
                .seed = 3};
    }
};

std::vector<double> losses(const Propagation& model, const LinkBatch& batch) {
    std::vector<double> out(batch.size(), no_number);
    model.loss(batch, {test::no_cutoff}, out);
    return out;
}

}  // namespace

TEST_CASE("every model: the loss is finite and not negative, at distance 0 and far away") {
    World world;
    world.to.insert(world.to.end(), {world.from, {1e6, 0, 0}, {0, 0, 1e5}, {-1e9, 1e9, 0}});
    world.keys.resize(world.to.size(), 1);
    for_each_variant([&](const auto& model) {
        for (const double f : {1800e6, 2450e6}) {
            for (const double loss : losses(model, world.batch({f}))) {
                CHECK(std::isfinite(loss));
                CHECK(loss >= 0);
            }
        }
    });
}

TEST_CASE("every model: the loss does not depend on time or frame, so it can be cached") {
    const World world;
    LinkBatch later = world.batch();
    later.at = start_of_run + Duration{12'345'678'901};
    later.frame = 77;
    for_each_variant(
        [&](const auto& model) { CHECK(losses(model, world.batch()) == losses(model, later)); });
}

TEST_CASE("every model: the loss is never negative, also at 1 MHz and at short distances") {
    for_each_variant([&](const auto& model) {
        if constexpr (requires { model.environment; }) {
            if (model.environment) return;  // has no row at 1 MHz
        }
        for (const double d : {0.0, 1e-9, 0.01, 1.0, 3.0}) {
            CHECK(test::loss_at(model, d, 1_MHz) >= 0);
        }
    });
}

TEST_CASE("every model: the loss is the same in both directions, to the last bit") {
    const World world;
    for_each_variant([&](const auto& model) {
        for (std::size_t i = 0; i < world.to.size(); ++i) {
            const test::OneLink there{.from = world.from,
                                      .to = world.to[i],
                                      .from_key = 7,
                                      .to_key = world.keys[i],
                                      .scene = &world.scene};
            const test::OneLink back{.from = world.to[i],
                                     .to = world.from,
                                     .from_key = world.keys[i],
                                     .to_key = 7,
                                     .scene = &world.scene};
            CHECK(there.loss(model) == back.loss(model));
        }
    });
}

TEST_CASE(
    "every model that needs only distance and heights: the loss never decreases with distance") {
    int checked = 0;
    for_each_variant([&](const auto& model) {
        const LossShape shape = model.shape();
        if (shape != LossShape::by_distance && shape != LossShape::by_heights) return;
        ++checked;
        double before = 0;
        for (double d = 0; d < 2000; d = d * 1.01 + 1e-3) {
            const double loss = test::loss_at(model, d);
            CHECK(loss >= before);
            before = loss;
        }
    });
    CHECK(checked >= 6);
}

TEST_CASE("every model: a link has the same loss if computed alone or together with other links") {
    World world;
    for_each_variant([&](const auto& model) {
        const auto together = losses(model, world.batch());
        std::vector<std::size_t> order(world.to.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::reverse(order.begin() + 7, order.end());
        World shuffled = world;
        for (std::size_t i = 0; i < order.size(); ++i) {
            shuffled.to[i] = world.to[order[i]];
            shuffled.keys[i] = world.keys[order[i]];
        }
        const auto mixed = losses(model, shuffled.batch());
        for (std::size_t i = 0; i < order.size(); ++i) {
            const std::size_t k = order[i];
            CHECK(mixed[i] == together[k]);
            auto single = world.batch();
            single.to = single.to.subspan(k, 1);
            single.to_keys = single.to_keys.subspan(k, 1);
            CHECK(losses(model, single).front() == together[k]);
        }
        World nobody(0);
        CHECK(losses(model, nobody.batch()).empty());
    });
}

TEST_CASE("every model: beyond the reach of a link budget, the loss exceeds this budget") {
    test::Draw draw(5);
    const Scene open_field;
    for_each_variant([&](const auto& model) {
        for (int i = 0; i < 300; ++i) {
            const double budget = draw.uniform(-20, 160);
            const Hertz f{draw.uniform(1700e6, 2700e6)};
            const double highest = draw.uniform(-2, 20);
            const double from = highest - draw.uniform(0, 3), to = highest - draw.uniform(0, 3);
            const double reach = Propagation(model).reach({budget}, f, {highest}).value;
            CHECK(reach >= 0);
            // A billionth beyond, which is what the medium allows for rounding, and farther.
            for (const double beyond : {1 + 1e-9, 1 + 1e-6, 1.5, 100.0}) {
                const test::OneLink link{.frequency = f,
                                         .from = {0, 0, from},
                                         .to = {reach * beyond + 1e-12, 0, to},
                                         .from_key = static_cast<std::uint64_t>(i)};
                CHECK(link.loss(model) > budget);
            }
        }
    });
}

TEST_CASE(
    "every model: up to the cut-off the loss is exact; beyond, it is any value above the cut-off") {
    World world;
    for_each_variant([&](const auto& model) {
        const auto exact = losses(model, world.batch());
        for (const double budget : {-1.0, 0.0, 50.0, 60.0, 70.0, 90.0, 999.0, 1000.0}) {
            std::vector<double> hasty(exact.size(), no_number);
            Propagation(model).loss(world.batch(), {budget}, hasty);
            for (std::size_t i = 0; i < exact.size(); ++i) {
                CHECK((exact[i] <= budget ? hasty[i] == exact[i] : hasty[i] > budget));
            }
        }
    });
}

TEST_CASE("every model: a missing parameter, or one out of its range, is refused") {
    int checked = 0;
    for_each_model([&]<class Model>() {
        for_each_field<Model>([&](const auto& f) {
            CAPTURE(std::string(Model::name));
            CAPTURE(std::string(f.name));
            const auto refuses = [&](double v) {
                if (f.range.contains(v)) return;
                auto model = typical<Model>();
                auto& member = model.*f.member;
                using T = std::remove_cvref_t<decltype(member)>;
                if constexpr (std::same_as<T, std::optional<int>>) {
                    member = std::isnan(v) ? -2 : static_cast<int>(v);
                } else if constexpr (std::same_as<T, double> ||
                                     std::same_as<T, std::optional<double>>) {
                    member = v;
                } else if constexpr (requires { member.value = v; }) {
                    member.value = v;
                } else {
                    return;  // words are the reader's to refuse
                }
                ++checked;
                CHECK_THROWS_AS(Propagation{model}, std::invalid_argument);
            };
            refuses(-1);
            refuses(no_number);
        });
    });
    CHECK(checked >= 14);
}

TEST_CASE("every model: infinite parameters are refused") {
    const double inf = std::numeric_limits<double>::infinity();
    CHECK_THROWS_AS(Propagation{Disc{.range = {inf}}}, std::invalid_argument);
    CHECK_THROWS_AS(Propagation{LogDistance{.sigma = {inf}}}, std::invalid_argument);
    CHECK_THROWS_AS(Propagation{Raytrace2007{.wall_factor = inf}}, std::invalid_argument);
}

TEST_CASE(
    "every model: the model's name is unique; it has only lower-case letters, digits and "
    "underscores") {
    std::vector<std::string> names;
    for_each_model([&]<class Model>() { names.emplace_back(Model::name); });
    std::sort(names.begin(), names.end());
    CHECK(std::adjacent_find(names.begin(), names.end()) == names.end());
    for (const auto& name : names) {
        CHECK(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_0123456789") == name.npos);
    }
}

}  // namespace conformance_test
