// SPDX-License-Identifier: MIT
#include "mobility/random_waypoint.hpp"

#include "network/network.hpp"
#include "test/mobility/lone_mover.hpp"
#include "test/models/vectors.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace random_waypoint_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::LoneMover;
using test::Sample;

namespace {

/// A mean of draws with fixed seeds; one in 16,000 such checks fails by chance with another seed.
constexpr double most_errors = 4;
/// A chi-square of many cells, whose tail is a little heavier than the normal one.
constexpr double most_chi_sigmas = 4.5;

std::vector<Vec3> box(double width, double height) { return {{0, 0}, {width, height}}; }

/// Robots of one model, each with its own draws, at one moment.
template <class Visit>
void crowd(const RandomWaypoint& model, int robots, Duration t, Visit visit, Vec3 at = {}) {
    const Scene field;
    Planners planners(field);
    for (int i = 0; i < robots; ++i) {
        LoneMover robot(planners, static_cast<std::uint64_t>(i) + 1, at);
        RandomWaypoint movement = model;
        REQUIRE(robot.walk_until(movement, t));
        visit(std::as_const(robot));
    }
}

Sample speeds_at(const RandomWaypoint& model, int robots, Duration t) {
    Sample speeds;
    crowd(model, robots, t, [&](const LoneMover& robot) { speeds.add(robot.speed()); });
    return speeds;
}

/// The mean length of every other of so many legs: those are independent.
Sample every_other_leg(double width, double height, int legs) {
    const Scene field;
    Planners planners(field);
    LoneMover robot(planners, 3);
    RandomWaypoint model{.area = box(width, height), .start = StartState::uniform};
    Sample lengths;
    for (int i = 0; i < legs; ++i) {
        REQUIRE(robot.walk(model));
        if (i % 2 == 0) lengths.add(robot.length());
    }
    return lengths;
}

/// The density of places [1/area] without pauses in the unit square:
///   f(x, y) = 1 / E[L]  integral over 0 ... pi of a1 a2 (a1 + a2),
/// with a1 and a2 from the place to the border along the angle and against it.
double stationary_density(double x, double y) {
    constexpr double mean_length = 0.5214054331647207;
    constexpr int steps = 4000;
    constexpr double pi = 3.141592653589793;
    const auto to_border = [&](double c, double s) {
        const double right = c > 0 ? (1 - x) / c : c < 0 ? -x / c : 9;
        const double up = s > 0 ? (1 - y) / s : s < 0 ? -y / s : 9;
        return std::min(right, up);
    };
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double angle = pi * (i + 0.5) / steps;
        const double c = std::cos(angle), s = std::sin(angle);
        const double ahead = to_border(c, s), behind = to_border(-c, -s);
        sum += ahead * behind * (ahead + behind);
    }
    return sum * pi / steps / mean_length;
}

}  // namespace

TEST_CASE("random_waypoint: the mean length of a trip is 0.5214 of the side of a square") {
    const Sample legs = every_other_leg(200, 200, 40'000);
    CHECK(legs.errors_off(200 * 0.5214054331647207, 200 * 0.247931) < most_errors);
    CHECK(std::abs(legs.deviation() / (200 * 0.247931) - 1) < 0.02);  // 4 / sqrt(2 n)
}

TEST_CASE("random_waypoint: the mean length of a trip in 1500 m x 300 m is 524.639 m") {
    const double deviation = std::sqrt((1500. * 1500 + 300. * 300) / 6 - 524.639 * 524.639);
    CHECK(every_other_leg(1500, 300, 40'000).errors_off(524.639, deviation) < most_errors);
}

TEST_CASE(
    "random_waypoint: trips follow each other without gaps, within the given area and speeds") {
    const Scene field;
    Planners planners(field);
    LoneMover robot(planners);
    RandomWaypoint model{
        .area = {{-5, 10}, {15, 18}}, .min_speed = {0.5}, .max_speed = {2}, .pause = 3s};
    REQUIRE(robot.walk(model));
    int rests = 0;
    for (int i = 0; i < 2000; ++i) {
        const Leg before = robot.leg;
        REQUIRE(robot.walk(model));
        const Leg& leg = robot.leg;
        REQUIRE(leg.start == before.end);
        REQUIRE(leg.from == before.to);
        REQUIRE(leg.to.x >= -5);
        REQUIRE(leg.to.x <= 15);
        REQUIRE(leg.to.y >= 10);
        REQUIRE(leg.to.y <= 18);
        if (leg.from == leg.to) {
            ++rests;
            REQUIRE(leg.end - leg.start == 3s);
        } else {
            constexpr double rounding = 1e-6;  // of the leg's end to a nanosecond
            REQUIRE(robot.speed() > 0.5 - rounding);
            REQUIRE(robot.speed() < 2 + rounding);
        }
    }
    CHECK(rests == 1000);
}

TEST_CASE(
    "random_waypoint: at any time the mean speed equals the stationary mean of the test vectors") {
    const test::Vectors vectors("rwp_speed_decay.csv");
    int checked = 0;
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const double low = vectors.number(i, "vmin"), high = vectors.number(i, "vmax");
        if (low < 0.01) continue;  // such slow trips outlast the test; see the next ones
        CAPTURE(low);
        CAPTURE(high);
        const double mean = vectors.number(i, "stationary_mean_(max-min)/ln(max/min)_no_pause");
        const double square = (high * high - low * low) / (2 * std::log(high / low));
        const double sigma = std::sqrt(square - mean * mean);
        const RandomWaypoint model{.area = box(50, 50), .min_speed = {low}, .max_speed = {high}};
        for (const Duration t : {0s, 20s, 300s}) {
            CHECK(speeds_at(model, 1000, t).errors_off(mean, sigma) < most_errors);
        }
        ++checked;
    }
    CHECK(checked == 18);
}

TEST_CASE(
    "random_waypoint: also for speeds down to 1e-6 m/s, the mean speed at the start equals the "
    "test vectors") {
    const double low = 1e-6, high = 20, mean = 1.1896799778838094;  // rwp_speed_decay.csv
    const double square = (high * high - low * low) / (2 * std::log(high / low));
    const RandomWaypoint model{.area = box(50, 50), .min_speed = {low}, .max_speed = {high}};
    const Sample speeds = speeds_at(model, 20'000, 0s);
    CHECK(speeds.errors_off(mean, std::sqrt(square - mean * mean)) < most_errors);
}

TEST_CASE(
    "random_waypoint: without a stationary start, the mean speed falls to the stationary mean") {
    const double low = 0.1, high = 20, nominal = 10.05, stationary = 3.755909399773321;
    for (const StartState start : {StartState::uniform, StartState::here}) {
        const RandomWaypoint model{
            .area = box(100, 100), .min_speed = {low}, .max_speed = {high}, .start = start};
        const double uniform_sigma = (high - low) / std::sqrt(12.0);
        CHECK(speeds_at(model, 4000, 0s).errors_off(nominal, uniform_sigma) < most_errors);
        const Sample later = speeds_at(model, 4000, 30s);
        CHECK(later.mean() < 0.7 * nominal);
        CHECK(later.mean() > 1.2 * stationary);
        const Sample late = speeds_at(model, 4000, 4000s);  // four of the slowest trips
        CHECK(late.errors_off(stationary, 4.6) < most_errors);
    }
}

TEST_CASE("random_waypoint: positions have the exact stationary density, at the start and later") {
    // Half of the last digit of the published values, and the sum's own error.
    constexpr double printed = 1e-5;
    CHECK(std::abs(stationary_density(0.5, 0.5) - 2.20135) < printed);
    CHECK(std::abs(stationary_density(0.1, 0.1) - 0.47623) < printed);
    CHECK(std::abs(stationary_density(0.25, 0.5) - 1.58158) < printed);

    constexpr int side = 8;
    const auto share = [](int column, int row) {
        double sum = 0;  // over 4 x 4 midpoints of the cell
        for (int i = 0; i < 16; ++i) {
            sum += stationary_density((column + (i % 4 + 0.5) / 4) / side,
                                      (row + (i / 4 + 0.5) / 4) / side);
        }
        return sum / 16 / (side * side);
    };
    const RandomWaypoint model{.area = box(1, 1), .min_speed = {0.1}, .max_speed = {1}};
    for (const Duration t : {0s, 40s}) {
        test::Histogram places({}, {1, 1}, side);
        crowd(model, 20'000, t,
              [&](const LoneMover& robot) { places.add(robot.leg.position(start_of_run + t)); });
        CHECK(std::abs(places.chi_square_sigmas(share)) < most_chi_sigmas);
        CHECK(places.uniform_chi_square_sigmas() > 100);
    }
}

TEST_CASE(
    "random_waypoint: in 1000 m x 600 m, speeds and positions pass ns-3's steady-state test") {
    // ns-3's test of its steady-state random waypoint model, with its tolerances.
    const RandomWaypoint model{.area = box(1000, 600), .min_speed = {0.01}, .max_speed = {20}};
    for (const Duration t : {Duration{1ms}, Duration{1000s}}) {
        Sample v, x, y;
        crowd(model, 10'000, t, [&](const LoneMover& robot) {
            const Vec3 p = robot.leg.position(start_of_run + t);
            v.add(robot.speed());
            x.add(p.x);
            y.add(p.y);
        });
        CHECK(std::abs(v.mean() - 2.6) < 0.13);
        CHECK(std::abs(v.deviation() - 4.4) < 0.22);
        CHECK(std::abs(x.mean() - 500) < 25);
        CHECK(std::abs(x.deviation() - 230) < 10);
        CHECK(std::abs(y.mean() - 300) < 15);
        CHECK(std::abs(y.deviation() - 140) < 7);
    }
}

TEST_CASE("random_waypoint: the share of robots at rest is always E[pause] / E[pause + trip]") {
    const double pause = 30, low = 0.5, high = 5;
    const double trip = 100 * 0.5214054331647207 * std::log(high / low) / (high - low);
    const double share = pause / (pause + trip);
    const RandomWaypoint model{
        .area = box(100, 100), .min_speed = {low}, .max_speed = {high}, .pause = 30s};
    for (const Duration t : {0s, 25s, 400s}) {
        Sample at_rest, rest_left;
        crowd(model, 5000, t, [&](const LoneMover& robot) {
            const bool rests = robot.speed() == 0;
            at_rest.add(rests);
            if (rests) rest_left.add(seconds(robot.leg.end - (start_of_run + t)));
        });
        CHECK(at_rest.errors_off(share, std::sqrt(share * (1 - share))) < most_errors);
        CHECK(rest_left.errors_off(pause / 2, pause / std::sqrt(12.0)) < most_errors);
    }
}

TEST_CASE("random_waypoint: the key `start` selects where a robot begins") {
    const Scene field;
    Planners planners(field);
    RandomWaypoint here{.area = box(10, 10), .start = StartState::here};
    LoneMover robot(planners, 1, {3, 4, 1.5});
    REQUIRE(robot.walk(here));
    CHECK(robot.leg.from == Vec3{3, 4, 1.5});
    CHECK(robot.leg.to.z == 1.5);

    Sample x;
    crowd({.area = box(10, 10), .start = StartState::uniform}, 4000, 0s,
          [&](const LoneMover& r) { x.add(r.leg.from.x); }, {90, 90});
    CHECK(x.errors_off(5, 10 / std::sqrt(12.0)) < most_errors);
}

TEST_CASE("random_waypoint: a movement that is set during the run begins at the robot's position") {
    Network net;
    const NodeId robot = net.add({.name = "A", .at = {77, 88}});
    net.run_until(start_of_run + 5s);
    net.move(robot, RandomWaypoint{.area = box(10, 10), .max_speed = {1}});
    CHECK(net.position(robot) == Vec3{77, 88});
    net.run_until(start_of_run + 6s);
    const double gone = distance(net.position(robot), {77, 88});
    CHECK(gone > 0.4);
    CHECK(gone < 1.1);
}

TEST_CASE("random_waypoint: adding a robot does not change the motion of other robots") {
    const auto places = [](bool more) {
        Network net({.seed = 9});
        if (more) net.add({.name = "B", .at = {}, .move = RandomWaypoint{.area = box(30, 30)}});
        const NodeId robot = net.add(
            {.name = "A", .at = {}, .move = RandomWaypoint{.area = box(30, 30), .pause = 2s}});
        std::vector<Vec3> seen;
        for (int t = 0; t < 200; t += 10) {
            net.run_until(start_of_run + t * 1s);
            seen.push_back(net.position(robot));
        }
        return seen;
    };
    CHECK(places(false) == places(true));
}

TEST_CASE(
    "random_waypoint: no trip exceeds the top speed, and slow trips are as frequent as in theory") {
    const Scene field;
    Planners planners(field);
    Sample v;
    for (std::uint64_t i = 0; i < 4000; ++i) {
        LoneMover robot(planners, i);
        robot.top_speed = {2};
        RandomWaypoint model{.area = box(50, 50), .min_speed = {0.5}, .max_speed = {20}};
        REQUIRE(robot.walk_until(model, 10s));
        REQUIRE(robot.speed() < 2 + 1e-6);
        v.add(robot.speed());
    }
    CHECK(v.errors_off(1.0820212806667227, 0.427) < most_errors);  // rwp_speed_decay.csv, [0.5, 2]
}

TEST_CASE("random_waypoint: on a map a robot starts and goes only where it fits") {
    const Scene office(test::drawn_map({
        "..........",
        ".####.###.",
        ".#......#.",
        ".#......#.",
        ".########.",
        "..........",
    }));
    Planners planners(office);
    for (const StartState start : {StartState::stationary, StartState::uniform}) {
        for (std::uint64_t i = 0; i < 50; ++i) {
            LoneMover robot(planners, i, {-50, -50}, 0.3_m);
            RandomWaypoint model{.pause = 1s, .start = start};
            for (int leg = 0; leg < 40; ++leg) {
                REQUIRE(robot.walk(model));
                REQUIRE(office.inside_map(robot.leg.from));
                REQUIRE(office.passable(robot.leg.from, robot.leg.to, 0.3_m));
            }
        }
    }
}

TEST_CASE("random_waypoint: on a map mean speed and share at rest do not change with time") {
    const Scene office(test::drawn_map({
        ".....#....",
        ".....#....",
        "..........",
        ".....#....",
        "###.##.###",
        "..........",
    }));
    Planners planners(office);
    std::vector<Sample> speeds(3), rests(3);
    const RandomWaypoint model{.min_speed = {0.1}, .max_speed = {2}, .pause = 4s};
    for (std::uint64_t i = 0; i < 1500; ++i) {
        LoneMover robot(planners, i);
        RandomWaypoint movement = model;
        for (const std::size_t k : {0u, 1u, 2u}) {
            REQUIRE(robot.walk_until(movement, k * 20s));
            rests[k].add(robot.speed() == 0);
            if (robot.speed() > 0) speeds[k].add(robot.speed());
        }
    }
    for (const std::size_t k : {0u, 1u, 2u}) {
        CHECK(speeds[k].errors_off(0.6342355813211347, 0.51) < most_errors);  // [0.1, 2]
        // Two shares of a half at most, from as many robots.
        CHECK(std::abs(rests[k].mean() - rests[0].mean()) < most_errors * std::sqrt(0.5 / 1500));
    }
}

TEST_CASE("random_waypoint: a robot that fits nowhere is blocked") {
    const Scene walled(test::drawn_map({"###", "#.#", "###"}));
    Planners planners(walled);
    for (const StartState start : {StartState::stationary, StartState::uniform, StartState::here}) {
        LoneMover robot(planners, 0, {1.5, 1.5}, 0.6_m);
        RandomWaypoint model{.start = start};
        CHECK_FALSE(robot.walk(model));
    }
}

TEST_CASE("random_waypoint: invalid parameters are refused") {
    const Scene field;
    Planners planners(field);
    const auto refused = [&](RandomWaypoint model, const std::string& part) {
        LoneMover robot(planners);
        try {
            robot.walk(model);
        } catch (const std::invalid_argument& error) {
            CAPTURE(error.what());
            return std::string(error.what()).find(part) != std::string::npos;
        }
        return false;
    };
    const auto area = box(1, 1);
    CHECK(refused({}, "the key \"area\" must be given, because the scene is an open field"));
    CHECK(refused({.area = {{0, 0}}}, "\"area\" must be two corners"));
    CHECK(refused({.area = {{0, 0}, {0, 5}}}, "right of the first corner and above"));
    CHECK(refused({.area = {{0, 0}, {-1, 5}}}, "right of the first corner and above"));
    CHECK(refused({.area = {{0, 0}, {std::nan(""), 5}}}, "right of the first corner and above"));
    CHECK(refused({.area = {{-1e308, 0}, {1e308, 5}}}, "right of the first corner and above"));
    CHECK(refused({.area = area, .min_speed = {0}}, "the mean speed decays to 0"));
    CHECK(refused({.area = area, .min_speed = {-1}}, "min_speed must be >= 0, got -1"));
    CHECK(refused({.area = area, .min_speed = {2}, .max_speed = {1}}, ">= min_speed = 2, got 1"));
    CHECK(refused({.area = area, .max_speed = {std::nan("")}}, "max_speed must be given"));
    CHECK(refused({.area = area, .pause = -1s}, "pause must be from 0 s"));
    const RandomWaypoint slow{.area = area, .min_speed = {0}, .start = StartState::uniform};
    CHECK_FALSE(refused(slow, ""));
}

}  // namespace random_waypoint_test
