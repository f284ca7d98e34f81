// SPDX-License-Identifier: MIT
#include "mobility/gauss_markov.hpp"

#include "mobility/planners.hpp"
#include "test/mobility/lone_mover.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace gauss_markov_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::LoneMover;
using test::Sample;

namespace {

/// A mean of draws with fixed seeds; one in 16,000 such checks fails by chance with another seed.
constexpr double most_errors = 4;

const std::vector<Vec3> plain{{-1e6, -1e6}, {1e6, 1e6}};

/// Speeds and directions of so many legs far from every border.
struct Course {
    std::vector<double> speeds{}, directions{};

    Course(GaussMarkov model, int legs) {
        const Scene field;
        Planners planners(field);
        LoneMover robot(planners, 1);
        model.area = plain;
        model.start = StartPlace::here;
        for (int i = 0; i < legs; ++i) {
            REQUIRE(robot.walk(model));
            REQUIRE(robot.leg.end - robot.leg.start == model.step);
            speeds.push_back(robot.speed());
            directions.push_back(robot.leg.heading);
        }
    }
};

Sample sample(const std::vector<double>& x) {
    Sample all;
    for (const double v : x) all.add(v);
    return all;
}

/// The correlation of a value with that `lag` later, for a known mean and standard deviation.
double correlation(const std::vector<double>& x, std::size_t lag, double mean, double sigma) {
    Sample products;
    for (std::size_t i = lag; i < x.size(); ++i) {
        products.add((x[i] - mean) * (x[i - lag] - mean) / (sigma * sigma));
    }
    return products.mean();
}

/// The standard error of the mean of n values with correlation a^k over k steps.
double standard_error(double sigma, double a, double n) {
    return sigma * std::sqrt((1 + a) / (1 - a) / n);
}

}  // namespace

TEST_CASE(
    "gauss_markov: speed and direction are normally distributed; their autocorrelation is "
    "`memory`^lag") {
    constexpr int legs = 40'000;
    for (const double a : {0.0, 0.5, 0.9}) {
        CAPTURE(a);
        const Course course({.mean_speed = {10},
                             .speed_sigma = {0.5},
                             .mean_direction = Radians{0.7},
                             .direction_sigma = {0.3},
                             .memory = a},
                            legs);
        const auto check = [&](const std::vector<double>& x, double mean, double sigma) {
            const Sample all = sample(x);
            CHECK(std::abs(all.mean() - mean) < most_errors * standard_error(sigma, a, legs));
            // Of a normal variable the square has deviation sqrt 2 and correlation a^2k.
            const double spread = standard_error(std::sqrt(2.0), a * a, legs);
            CHECK(std::abs(all.deviation() / sigma - 1) < most_errors * spread / 2);
            for (const std::size_t lag : {1u, 2u, 7u}) {
                const double expected = std::pow(a, static_cast<double>(lag));
                CHECK(std::abs(correlation(x, lag, mean, sigma) - expected) < most_errors * spread);
            }
        };
        check(course.speeds, 10, 0.5);
        check(course.directions, 0.7, 0.3);
    }
}

TEST_CASE("gauss_markov: with `memory` = 1, speed and direction never change") {
    const Course course({.memory = 1}, 100);
    CHECK(sample(course.speeds).deviation() < 1e-6);
    CHECK(sample(course.directions).deviation() < 1e-6);
}

TEST_CASE("gauss_markov: the first direction is random, unless it is given") {
    const Scene field;
    Planners planners(field);
    Sample x, y;
    for (std::uint64_t i = 0; i < 4000; ++i) {
        LoneMover robot(planners, i);
        GaussMarkov model{.area = plain, .speed_sigma = {0}};
        REQUIRE(robot.walk(model));
        x.add(robot.leg.velocity.x);
        y.add(robot.leg.velocity.y);
    }
    CHECK(x.errors_off(0, std::sqrt(0.5)) < most_errors);
    CHECK(y.errors_off(0, std::sqrt(0.5)) < most_errors);
}

TEST_CASE("gauss_markov: a robot never leaves its area, visits all of it and never gets stuck") {
    const Scene field;
    Planners planners(field);
    for (const double mean : {0.0, 1.0, 50.0}) {
        CAPTURE(mean);
        LoneMover robot(planners, 4);
        GaussMarkov model{.area = {{0, 0}, {40, 20}}, .mean_speed = {mean}, .speed_sigma = {1}};
        Sample x;
        for (int i = 0; i < 20'000; ++i) {
            REQUIRE(robot.walk(model));
            REQUIRE(robot.leg.end > robot.leg.start);
            REQUIRE(robot.leg.to.x >= 0);
            REQUIRE(robot.leg.to.x <= 40);
            REQUIRE(robot.leg.to.y >= 0);
            REQUIRE(robot.leg.to.y <= 20);
            x.add(robot.leg.to.x);
        }
        CHECK(std::abs(x.mean() - 20) < 4);
        CHECK(x.deviation() > 6);
    }
}

TEST_CASE("gauss_markov: a robot that moves backward also turns at a border") {
    const Scene field;
    Planners planners(field);
    int backwards = 0;
    for (std::uint64_t i = 0; i < 20; ++i) {
        LoneMover robot(planners, i);
        GaussMarkov model{
            .area = {{0, 0}, {9, 9}}, .mean_speed = {0}, .speed_sigma = {2}, .memory = 1};
        for (int k = 0; k < 200; ++k) REQUIRE(robot.walk(model));
        backwards += model.progress.speed < 0;
    }
    CHECK(backwards > 0);
}

TEST_CASE("gauss_markov: a robot near a border turns before it reaches the border") {
    const Scene field;
    Planners planners(field);
    LoneMover robot(planners, 4);
    GaussMarkov model{.area = {{0, 0}, {400, 400}}, .direction_sigma = {0.1}, .memory = 0.5};
    int on_border = 0;
    for (int i = 0; i < 20'000; ++i) {
        REQUIRE(robot.walk(model));
        const Vec3 p = robot.leg.to;
        on_border += p.x == 0 || p.y == 0 || p.x == 400 || p.y == 400;
    }
    CHECK(on_border == 0);
}

TEST_CASE("gauss_markov: the robot's top speed is never exceeded") {
    const Scene field;
    Planners planners(field);
    LoneMover robot(planners, 4);
    robot.top_speed = {2};
    GaussMarkov model{.area = plain, .mean_speed = {2}, .speed_sigma = {1}};
    for (int i = 0; i < 1000; ++i) {
        REQUIRE(robot.walk(model));
        REQUIRE(robot.speed() <= 2 + 1e-6);
    }
}

TEST_CASE("gauss_markov: a robot turns around at a wall") {
    const Scene map(test::drawn_map({"....#.....", "....#.....", "....#....."}));
    Planners planners(map);
    LoneMover robot(planners, 1, {1, 1.5}, 0.25_m);
    GaussMarkov model{.mean_speed = {1},
                      .speed_sigma = {0},
                      .mean_direction = Radians{0},
                      .direction_sigma = {0},
                      .memory = 0,
                      .start = StartPlace::here};
    for (int i = 0; i < 3; ++i) REQUIRE(robot.walk(model));
    CHECK(std::abs(robot.leg.to.x - 3.75) < 2e-6);  // a micrometre before it touches
    REQUIRE(robot.walk(model));
    CHECK(std::abs(robot.leg.to.x - 2.75) < 2e-6);
}

TEST_CASE(
    "gauss_markov: invalid parameters are refused, and a robot that fits nowhere is blocked") {
    const Scene field;
    Planners planners(field);
    const auto refused = [&](GaussMarkov model) {
        LoneMover robot(planners);
        CHECK_THROWS_AS(robot.walk(model), std::invalid_argument);
    };
    refused({});
    refused({.area = plain, .memory = 1.1});
    refused({.area = plain, .memory = -0.1});
    refused({.area = plain, .speed_sigma = {-1}});
    refused({.area = plain, .mean_direction = Radians{std::nan("")}});
    refused({.area = plain, .step = 0s});

    const Scene map(test::drawn_map({"###", "#.#", "###"}));
    Planners narrow(map);
    for (const StartPlace start : {StartPlace::uniform, StartPlace::here}) {
        LoneMover stuck(narrow, 0, {1.5, 1.5}, 0.6_m);
        GaussMarkov no_room{.start = start};
        CHECK_FALSE(stuck.walk(no_room));
    }
}

}  // namespace gauss_markov_test
