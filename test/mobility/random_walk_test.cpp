// SPDX-License-Identifier: MIT
#include "mobility/random_walk.hpp"

#include "test/mobility/lone_mover.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace random_walk_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::LoneMover;
using test::Sample;

namespace {

/// A mean of draws with fixed seeds; one in 16,000 such checks fails by chance with another seed.
constexpr double most_errors = 4;
/// A chi-square of many cells, whose tail is a little heavier than the normal one.
constexpr double most_chi_sigmas = 4.5;

}  // namespace

TEST_CASE("random_walk: positions and speeds are uniformly distributed, at the start and later") {
    const Scene field;
    Planners planners(field);
    const RandomWalk model{
        .area = {{0, 0}, {50, 20}}, .min_speed = {0.5}, .max_speed = {5}, .step = 8s};
    for (const Duration t : {0s, 3s, 8s, 100s}) {
        test::Histogram places({}, {50, 20}, 10);
        Sample speeds;
        for (std::uint64_t i = 0; i < 20'000; ++i) {
            LoneMover robot(planners, i);
            RandomWalk movement = model;
            REQUIRE(robot.walk_until(movement, t));
            places.add(robot.leg.position(start_of_run + t));
            speeds.add(robot.speed());
        }
        CHECK(std::abs(places.uniform_chi_square_sigmas()) < most_chi_sigmas);
        CHECK(speeds.errors_off(2.75, 4.5 / std::sqrt(12.0)) < most_errors);
    }
}

TEST_CASE("random_walk: the mean squared distance from the start is that of independent steps") {
    const Scene field;
    Planners planners(field);
    // E[d^2] = steps (v step)^2, and d^2 / E is nearly exponential: its deviation is its mean.
    const double steps = 100, length = 2 * 10;
    Sample squares;
    for (std::uint64_t i = 0; i < 4000; ++i) {
        LoneMover robot(planners, i, {0, 0});
        RandomWalk model{.area = {{-1e5, -1e5}, {1e5, 1e5}},
                         .min_speed = {2},
                         .max_speed = {2},
                         .step = 10s,
                         .start = StartPlace::here};
        for (int k = 0; k < steps; ++k) REQUIRE(robot.walk(model));
        CHECK(robot.leg.end == start_of_run + 1000s);
        squares.add(dot(robot.leg.to, robot.leg.to));
    }
    const double expected = steps * length * length;
    CHECK(squares.errors_off(expected, expected) < most_errors);
}

TEST_CASE("random_walk: borders reflect a robot like mirrors, without loss of time") {
    const Scene field;
    Planners planners(field);
    const double width = 3, height = 2;
    constexpr double tolerance = 1e-5;  // [m] each of many legs ends within 1 ns
    int bounces = 0;
    for (std::uint64_t i = 0; i < 100; ++i) {
        LoneMover robot(planners, i, {1, 0.5});
        RandomWalk model{.area = {{0, 0}, {width, height}}, .step = 20s, .start = StartPlace::here};
        REQUIRE(robot.walk(model));
        const Vec3 v = robot.leg.velocity;
        while (robot.leg.end < start_of_run + 20s) {
            REQUIRE(robot.walk(model));
            ++bounces;
        }
        CHECK(robot.leg.end == start_of_run + 20s);
        // Unfolded, the walk is straight; folded back, it ends where the robot is.
        const auto folded = [](double x, double size) {
            const double period = x - 2 * size * std::floor(x / (2 * size));
            return period > size ? 2 * size - period : period;
        };
        CHECK(std::abs(robot.leg.to.x - folded(1 + 20 * v.x, width)) < tolerance);
        CHECK(std::abs(robot.leg.to.y - folded(0.5 + 20 * v.y, height)) < tolerance);
    }
    CHECK(bounces > 500);
}

TEST_CASE("random_walk: straight legs join without gaps, stay in area and map, and cross no wall") {
    const Scene map(test::drawn_map({"......", "..##..", "......", "......"}));
    Planners planners(map);
    LoneMover robot(planners, 2, {}, 0.4_m);
    RandomWalk model{.area = {{1, 0}, {9, 9}}, .step = 3s};
    REQUIRE(robot.walk(model));
    for (int i = 0; i < 5000; ++i) {
        const Leg before = robot.leg;
        REQUIRE(robot.walk(model));
        REQUIRE(robot.leg.start == before.end);
        REQUIRE(robot.leg.from == before.to);
        REQUIRE(robot.leg.to.x >= 1);
        REQUIRE(map.inside_map(robot.leg.to));
        REQUIRE(map.passable(robot.leg.from, robot.leg.to, 0.4_m));
    }
}

TEST_CASE("random_walk: invalid parameters are refused, and a robot that fits nowhere is blocked") {
    const Scene field;
    Planners planners(field);
    const auto refused = [&](RandomWalk model) {
        LoneMover robot(planners);
        CHECK_THROWS_AS(robot.walk(model), std::invalid_argument);
    };
    refused({});
    refused({.area = {{0, 0}, {1, 1}}, .step = 0s});
    refused({.area = {{0, 0}, {1, 1}}, .max_speed = {0}});
    refused({.area = {{1, 1}, {2, 2}}, .start = StartPlace::here});

    const Scene map(test::drawn_map({"###", "#.#", "###"}));
    Planners narrow(map);
    for (const StartPlace start : {StartPlace::uniform, StartPlace::here}) {
        LoneMover stuck(narrow, 0, {1.5, 1.5}, 0.6_m);
        RandomWalk no_room{.start = start};
        CHECK_FALSE(stuck.walk(no_room));
    }
}

}  // namespace random_walk_test
