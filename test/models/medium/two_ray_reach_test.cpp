// SPDX-License-Identifier: MIT
#include "models/medium/link_range.hpp"
#include "models/medium/medium.hpp"
#include "models/propagation/two_ray.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace two_ray_reach_test {
using namespace rovernet;

namespace {

using namespace std::chrono_literals;

/// Robots over flat ground that climb, jump, sink and come later.
struct Ground {
    Scene scene{};
    Legs legs{};
    Medium medium{{.scene = &scene}};
    test::Draw draw;
    TwoRay model;

    explicit Ground(std::uint32_t seed)
        : draw(seed), model{.form = seed % 2 ? TwoRayForm::ns2 : TwoRayForm::exact} {}

    Leg leg(Time now, double top) {
        const Vec3 from{draw.uniform(0, 2000), draw.uniform(0, 2000), draw.uniform(0, top)};
        if (draw.below(2)) return {.start = now, .from = from, .to = from};
        const Vec3 velocity{draw.uniform(-20, 20), draw.uniform(-20, 20), draw.uniform(-9, 9)};
        if (draw.below(8) == 0) return {.start = now, .from = from, .velocity = velocity};
        return {.start = now,
                .end = now + 2s,
                .from = from,
                .velocity = velocity,
                .to = from + 2.0 * velocity};
    }
    void add(Time now, double top) {
        medium.add({.power = {10}, .antenna_height = {draw.uniform(0, 2)}}, legs.size() + 1, model);
        legs.add(leg(now, top));
    }
    void replace(Time now, double top) {
        const auto robots = static_cast<int>(legs.size());
        const NodeId node{static_cast<std::uint32_t>(draw.below(robots))};
        legs.replace(node, leg(now, top));
        medium.moved(node, legs);
    }
    /// Pairs that are linked at `now`, as the search and as each pair says.
    std::size_t compare(Time now) {
        std::size_t links = 0;
        for (std::uint32_t i = 0; i < legs.size(); ++i) {
            std::vector<NodeId> found, each;
            for (const auto& f : medium.hearers(NodeId{i}, now, legs)) found.push_back(f.node);
            std::sort(found.begin(), found.end());
            for (std::uint32_t k = 0; k < legs.size(); ++k) {
                if (medium.links().is_up(NodeId{i}, NodeId{k}, now, legs))
                    each.push_back(NodeId{k});
            }
            CHECK(found == each);
            links += each.size();
        }
        return links;
    }
};

}  // namespace

TEST_CASE(
    "two-ray: no receiver is missed as robots climb, jump, or are added higher than the others") {
    std::size_t links = 0;
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
        Ground ground(seed);
        for (int i = 0; i < 40; ++i) ground.add(start_of_run, 0.5);
        for (int step = 0; step < 20; ++step) {
            const Time now = start_of_run + step * 300ms;
            links += ground.compare(now);
            ground.replace(now, 1 + 10.0 * step);
            if (step % 4 == 0) ground.add(now, 1 + 10.0 * step);
        }
    }
    CHECK(links > 3000);
}

TEST_CASE(
    "two-ray: if antenna heights are equal, comparing distances decides exactly whether a link is "
    "up") {
    Ground ground(1);
    const Radio radio{.power = {10}, .antenna_height = {1.5}};
    const auto add = [&](double x) {
        ground.medium.add(radio, ground.legs.size() + 1, ground.model);
        ground.legs.add({.from = {x, 0, 0}, .to = {x, 0, 0}});
    };
    const double range = std::sqrt(largest_squared_distance(
        ground.model, radio.frequency, link_budget(radio, radio), radio.antenna_height));
    add(0);
    constexpr double ulp = std::numeric_limits<double>::epsilon();
    for (int k = -8; k <= 8; ++k) add(range * (1 + k * ulp));
    for (int k = 0; k < 40; ++k) add(ground.draw.uniform(0, 3 * range));
    const auto decision = [&] {
        return ground.medium.stations().kinds().decision(ground.medium.stations().kind(NodeId{0}));
    };
    CHECK(ground.compare(start_of_run) > 500);
    CHECK(decision() == Decision::by_range);
    const Vec3 from{range, 0, 0}, up{0, 0, 1};
    ground.legs.replace(NodeId{1}, {.start = start_of_run,
                                    .end = start_of_run + 9s,
                                    .from = from,
                                    .velocity = up,
                                    .to = from + 9.0 * up});
    ground.medium.moved(NodeId{1}, ground.legs);
    CHECK(decision() == Decision::by_loss);
    CHECK(ground.compare(start_of_run + 8s) > 500);
}

TEST_CASE("two-ray: over 4 km of flat ground, only nearby robots are checked as receivers") {
    Scene scene;
    Legs legs;
    Medium medium({.scene = &scene});
    const Radio radio{.power = {24.5}, .sensitivity = {-64.374}, .frequency = {914e6}};
    for (int i = 0; i < 40; ++i) {
        medium.add(radio, static_cast<std::uint64_t>(i), TwoRay{});
        const Vec3 at{100.0 * i, 0, 0.5};
        legs.add({.from = at, .to = at});
    }
    CHECK(medium.hearers(NodeId{20}, start_of_run, legs).size() == 4);
    const double reach2 = medium.arrivals().squared_reach(NodeId{20});
    CHECK(std::sqrt(reach2) == doctest::Approx(250).epsilon(1e-3));
}

}  // namespace two_ray_reach_test
