// SPDX-License-Identifier: MIT
// Robots at walls make few legs: simulated time goes on, whatever a robot touches.
#include "mobility/driven.hpp"
#include "mobility/follow_wall.hpp"
#include "mobility/planners.hpp"
#include "mobility/random_walk.hpp"
#include "mobility/wander.hpp"
#include "mobility/waypoints.hpp"
#include "test/mobility/lone_mover.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace liveness_test {
using namespace rovernet;
using test::LoneMover;

namespace {

/// Rooms, pillars of one cell, a slanted row of cells, a niche as wide as a small robot.
OccupancyGrid rooms(double cell, double yaw) {
    OccupancyGrid map = test::drawn_map(
        {"########################", "#......#...............#", "#......#....#..........#",
         "#..........###.........#", "#......#....#......#...#", "####.###..........##...#",
         "#................##....#", "#...#...........##.....#", "#..............##......#",
         "#......#.#.............#", "#......#.#......?......#", "......................##"},
        cell);
    map.yaw = yaw;
    map.origin = {3, -2, 0};
    return map;
}

/// What a robot did on its legs.
struct Count {
    int legs = 0;
    int contacts = 0;  ///< times that it came to stand
    int through_walls = 0;
    double longest_pause = 0;  ///< [s] that it stood at one place
};

/// Walks for `span` [s], for at most so many legs.
template <class Model>
Count walk(const Scene& scene, LoneMover robot, Model model, Meters radius, double span,
           int most_legs) {
    Count count;
    bool stood = false;
    double stands_since = 0;
    while (seconds(robot.leg.end - start_of_run) < span && count.legs < most_legs) {
        const Time before = robot.leg.end;
        if (!robot.walk(model) || robot.leg.end == never) break;
        REQUIRE(robot.leg.end > before);
        ++count.legs;
        const bool stands = robot.leg.velocity == Vec3{};
        count.contacts += stands && !stood;
        if (stands && !stood) stands_since = seconds(before - start_of_run);
        if (stands) {
            const double pause = seconds(robot.leg.end - start_of_run) - stands_since;
            count.longest_pause = std::max(count.longest_pause, pause);
        }
        stood = stands;
        count.through_walls += !scene.passable(robot.leg.from, robot.leg.to, radius);
    }
    return count;
}

/// A robot somewhere on the map.
LoneMover placed(Planners& planners, std::uint64_t number, Meters radius) {
    LoneMover robot(planners, number, {}, radius);
    RandomWalk anywhere;
    REQUIRE(robot.walk(anywhere));
    return LoneMover(planners, number, robot.leg.from, radius);
}

/// Time of a chord whose sagitta is a millimetre, or of a quarter turn [s].
double chord_time(double v, double w) {
    return std::min(std::sqrt(0.008 / std::abs(v * w)), std::numbers::pi / 2 / std::abs(w));
}

/// The rule before contacts were known: as far as the body can go, again and again.
struct Creeping : Driven {
    Step next_leg(Mover& mover) {
        Leg leg = standing_leg(mover);
        leg.turning = turn_rate.value;
        leg.end = mover.now + Duration{1};
        return leg;
    }
};

template <class Model>
int robots_with_too_many_legs(const Scene& scene, int robots, double* worst = nullptr) {
    test::Draw draw(5);
    Planners planners(scene);
    int failed = 0;
    for (int i = 0; i < robots; ++i) {
        const Meters radius{draw.uniform(0.02, 0.3)};
        const auto rate = [&] {
            return std::pow(10, draw.uniform(-2, 3)) * (draw.below(2) ? 1 : -1);
        };
        Model model;
        model.speed = {rate()};
        model.turn_rate = {rate()};
        const double chord = chord_time(model.speed.value, model.turn_rate.value);
        const double span = std::min(300 * chord, 1000.0);
        const LoneMover robot = placed(planners, static_cast<std::uint64_t>(i), radius);
        const Count count = walk(scene, robot, model, radius, span, 5000);
        const double allowed = std::ceil(span / chord) + 1 + 4 * count.contacts;
        if (worst) *worst = std::max(*worst, count.legs / allowed);
        failed += count.legs > allowed;
        CHECK(count.through_walls == 0);
    }
    return failed;
}

}  // namespace

TEST_CASE(
    "liveness: on an arc, each contact with a wall adds at most 4 straight legs to the path") {
    for (const double yaw : {0.0, 0.4, std::numbers::pi}) {
        CAPTURE(yaw);
        const Scene scene(rooms(0.5, yaw));
        CHECK(robots_with_too_many_legs<Driven>(scene, 200) == 0);
        CHECK(robots_with_too_many_legs<Creeping>(scene, 10) == 10);
    }
}

TEST_CASE(
    "liveness: on an arc, a robot stops at a wall, turns until parallel to the wall, and leaves") {
    const Scene scene(test::drawn_map({"..........", "..........", "..........", "##########"}));
    Planners planners(scene);
    // 0.5 m/s at -0.3 rad from a millimetre before contact, 1 rad/s to the left.
    LoneMover robot(planners, 0, {5, 1.201, 0});
    robot.leg.heading = -0.3;
    Driven drive{.speed = {0.5}, .turn_rate = {1}};
    REQUIRE(robot.walk(drive));
    // cos(0.3 - t) - cos(0.3) = 0.001 w / v, a micrometre of way less.
    const double contact = 0.3 - std::acos(std::cos(0.3) + 0.002);
    CHECK(seconds(robot.leg.end - start_of_run) < contact);
    CHECK(seconds(robot.leg.end - start_of_run) > contact - 3e-6);
    const double x = robot.leg.to.x;
    REQUIRE(robot.walk(drive));
    CHECK(robot.leg.velocity == Vec3{});
    CHECK(std::abs(seconds(robot.leg.end - start_of_run) - 0.3) < 2e-9);
    REQUIRE(robot.walk(drive));
    // From there on the arc of radius 0.5 m that leaves the wall.
    const double t = seconds(robot.leg.end - start_of_run) - 0.3;
    CHECK(t > 0.1);
    CHECK(std::abs(robot.leg.to.x - (x + 0.5 * std::sin(t))) < 1e-6);
    CHECK(std::abs(robot.leg.to.y - (1.2 + 0.5 * (1 - std::cos(t)))) < 2e-6);
}

TEST_CASE(
    "liveness: on arcs driven backward or to the right, robots also stop at walls, corners and "
    "borders") {
    const Scene scene(test::drawn_map({"........", "...##...", "...##...", "........"}));
    Planners planners(scene);
    const auto legs_at = [&](Vec3 at, double heading, double v, double w) {
        LoneMover robot(planners, 0, at);
        robot.leg.heading = heading;
        return walk(scene, robot, Driven{.speed = {v}, .turn_rate = {w}}, Meters{0.2}, 20, 9999);
    };
    for (const auto& begin : std::vector<std::pair<Vec3, double>>{{{2.79, 2, 0}, 0.1},
                                                                  {{2.85, 0.85, 0}, 0.8},
                                                                  {{0.001, 2, 0}, 3.1},
                                                                  {{4, 0, 0}, -1.5}}) {
        for (const double sign : {1.0, -1.0}) {
            const Vec3 at = begin.first;
            const double heading = begin.second;
            CAPTURE(at.x);
            CAPTURE(sign);
            const Count ahead = legs_at(at, heading, 0.5, sign);
            const Count back = legs_at(at, heading + std::numbers::pi, -0.5, sign);
            CHECK(ahead.contacts > 0);
            CHECK(ahead.legs <= std::ceil(20 / chord_time(0.5, 1)) + 1 + 4 * ahead.contacts);
            CHECK(back.legs == ahead.legs);
            // No wall holds it for longer than half a turn.
            CHECK(ahead.longest_pause < std::numbers::pi + 0.2);
        }
    }
}

TEST_CASE(
    "liveness: the models `follow_wall` and `wander` make at most 11 straight legs a second, at "
    "any sensor range") {
    const Scene scene(rooms(0.5, 0.0));
    Planners planners(scene);
    test::Draw draw(11);
    for (int i = 0; i < 12; ++i) {
        const Meters radius{draw.uniform(0.05, 0.24)}, keep{draw.uniform(0.01, 0.6)};
        const Meters range{draw.uniform(0.02, 1.6)};
        CAPTURE(radius.value);
        CAPTURE(keep.value);
        CAPTURE(range.value);
        const LoneMover robot = placed(planners, static_cast<std::uint64_t>(i), radius);
        const FollowWall follow{.keep = keep, .range = range};
        const Count strides = walk(scene, robot, follow, radius, 60, 3000);
        CHECK(strides.legs <= 660);  // a stride of 0.1 m takes 0.2 s
        CHECK(strides.through_walls == 0);
        const Wander wander{.keep = keep, .range = range};
        const Count looks = walk(scene, robot, wander, radius, 60, 3000);
        CHECK(looks.legs <= 660);
        CHECK(looks.longest_pause < 30);  // it does not stand for ever
        CHECK(looks.through_walls == 0);
    }
}

TEST_CASE(
    "liveness: a robot at a wall reaches its goal in fewer straight legs than the map has cells") {
    const Scene scene(rooms(0.5, 0.4));
    Planners planners(scene);
    for (std::uint64_t i = 0; i < 100; ++i) {
        const Meters radius{0.1};
        LoneMover robot = placed(planners, 2 * i, radius);
        // It stands at a wall, as an arc has left it.
        robot.leg.heading = static_cast<double>(i);
        robot.leg.end = start_of_run;
        Driven drive{.speed = {0.7}, .until = start_of_run + from_seconds(20)};
        while (robot.leg.end < *drive.until) REQUIRE(robot.walk(drive));
        const Vec3 goal = placed(planners, 2 * i + 1, radius).leg.from;
        Movement to = ToGoal{goal};
        int legs = 0;
        while (robot.walk(to)) REQUIRE(++legs < 24 * 12);
        CHECK(robot.leg.to == goal);
    }
}

}  // namespace liveness_test
