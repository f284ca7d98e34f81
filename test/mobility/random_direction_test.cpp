// SPDX-License-Identifier: MIT
#include "mobility/random_direction.hpp"

#include "test/mobility/lone_mover.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace random_direction_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::LoneMover;
using test::Sample;

namespace {

/// A mean of draws with fixed seeds; one in 16,000 such checks fails by chance with another seed.
constexpr double most_errors = 4;
/// A chi-square of many cells, whose tail is a little heavier than the normal one.
constexpr double most_chi_sigmas = 4.5;

const std::vector<Vec3> hall{{0, 0}, {100, 60}};

bool on_border(Vec3 p) { return p.x == 0 || p.x == 100 || p.y == 0 || p.y == 60; }

/// Where 20,000 robots are at `t`, and how fast.
struct Crowd {
    test::Histogram places{{0, 0}, {100, 60}, 10};
    Sample speeds{};

    Crowd(const RandomDirection& model, Duration t) {
        const Scene field;
        Planners planners(field);
        for (std::uint64_t i = 0; i < 20'000; ++i) {
            LoneMover robot(planners, i);
            RandomDirection movement = model;
            REQUIRE(robot.walk_until(movement, t));
            places.add(robot.leg.position(start_of_run + t));
            speeds.add(robot.speed());
        }
    }
};

}  // namespace

TEST_CASE("random_direction: positions are uniformly distributed, at the start and later") {
    const RandomDirection model{.area = hall, .min_speed = {0.5}, .max_speed = {5}};
    for (const Duration t : {0s, 15s, 60s, 300s}) {
        CHECK(std::abs(Crowd(model, t).places.uniform_chi_square_sigmas()) < most_chi_sigmas);
    }
}

TEST_CASE("random_direction: the mean speed does not change with time") {
    const double low = 0.5, high = 5, mean = (high - low) / std::log(high / low);
    const double square = (high * high - low * low) / (2 * std::log(high / low));
    const RandomDirection model{.area = hall, .min_speed = {low}, .max_speed = {high}};
    for (const Duration t : {0s, 60s, 300s}) {
        const double sigma = std::sqrt(square - mean * mean);
        CHECK(Crowd(model, t).speeds.errors_off(mean, sigma) < most_errors);
    }
}

TEST_CASE("random_direction: with `border_turn` = `uniform`, robots gather along the borders") {
    const RandomDirection model{
        .area = hall, .min_speed = {0.5}, .max_speed = {5}, .border_turn = BorderTurn::uniform};
    CHECK(Crowd(model, 300s).places.uniform_chi_square_sigmas() > 20);
}

TEST_CASE(
    "random_direction: the mean length of a trip is pi times area over border length (Cauchy)") {
    const Scene field;
    Planners planners(field);
    LoneMover robot(planners);
    RandomDirection model{.area = hall};
    Sample lengths;
    for (int i = 0; i < 200'000; ++i) {
        REQUIRE(robot.walk(model));
        REQUIRE(on_border(robot.leg.to));
        if (i % 5 == 4) lengths.add(robot.length());  // near enough to independent
    }
    CHECK(lengths.errors_off(3.141592653589793 * 6000 / 320, lengths.deviation()) < most_errors);
}

TEST_CASE("random_direction: a robot rests after each straight trip") {
    const Scene field;
    Planners planners(field);
    LoneMover robot(planners, 5, {20, 30});
    RandomDirection model{.area = hall, .pause = 7s, .start = StartPlace::here};
    REQUIRE(robot.walk(model));
    CHECK(robot.leg.from == Vec3{20, 30});
    for (int i = 0; i < 100; ++i) {
        const Vec3 border = robot.leg.to;
        CHECK(on_border(border));
        REQUIRE(robot.walk(model));
        CHECK(robot.leg.from == border);
        CHECK(robot.leg.to == border);
        CHECK(robot.leg.end - robot.leg.start == 7s);
        REQUIRE(robot.walk(model));
        CHECK(robot.length() > 0);
    }
}

TEST_CASE("random_direction: a robot stops before a wall") {
    const Scene map(test::drawn_map({"..........", "..........", ".......#..", ".........."}));
    Planners planners(map);
    int at_wall = 0, clear = 0;
    LoneMover robot(planners, 1, {2, 2}, 0.5_m);
    RandomDirection model;
    for (int i = 0; i < 2000; ++i) {
        REQUIRE(robot.walk(model));
        REQUIRE(map.passable(robot.leg.from, robot.leg.to, 0.5_m));
        const double gap = map.clearance(robot.leg.to) - 0.5;
        if (gap > 1e-3) continue;
        ++at_wall;
        CHECK(gap < 2e-6);    // a micrometre along the leg, at most
        clear += gap > 1e-8;  // not where rounding would decide whether the next leg may begin
    }
    CHECK(at_wall > 50);
    CHECK(clear > 0.9 * at_wall);
}

TEST_CASE(
    "random_direction: a start outside the area is refused; a robot that fits nowhere is blocked") {
    const Scene field;
    Planners planners(field);
    LoneMover outside(planners, 0, {101, 30});
    RandomDirection model{.area = hall, .start = StartPlace::here};
    CHECK_THROWS_AS(outside.walk(model), std::invalid_argument);

    const Scene map(test::drawn_map({"###", "#.#", "###"}));
    Planners narrow(map);
    for (const StartPlace start : {StartPlace::uniform, StartPlace::here}) {
        LoneMover stuck(narrow, 0, {1.5, 1.5}, 0.6_m);
        RandomDirection no_room{.start = start};
        CHECK_FALSE(stuck.walk(no_room));
    }
}

}  // namespace random_direction_test
