// SPDX-License-Identifier: MIT
// Movement in a building of several storeys: stairs, and what a robot sees of its own storey.
#include "mobility/look_round.hpp"
#include "mobility/random_waypoint.hpp"
#include "mobility/wander.hpp"
#include "mobility/waypoints.hpp"
#include "network/network.hpp"
#include "test/mobility/lone_mover.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <variant>
#include <vector>

namespace mobility_storeys_test {
using namespace rovernet;

namespace {

using namespace std::chrono_literals;

constexpr double tolerance = 1e-9;  // [m]

bool near(double a, double b) { return std::abs(a - b) <= tolerance; }
bool near(Vec3 a, Vec3 b) { return distance(a, b) <= tolerance; }

/// Cells of 1 m. Below, a wall with a door at the right; above, one with a door at the left.
std::shared_ptr<const Scene> building() {
    OccupancyGrid upper = test::drawn_map({
        "..........",
        "..........",
        "..########",
        "..........",
        "..........",
    });
    upper.origin.z = 3;
    return std::make_shared<const Scene>(std::vector{test::drawn_map({
                                                         "..........",
                                                         "..........",
                                                         "########..",
                                                         "..........",
                                                         "..........",
                                                     }),
                                                     upper},
                                         std::vector{Material{}});
}

constexpr Meters body{0.2};

/// Ends of the legs that the path takes from a place, with that place; empty if it is blocked.
std::vector<Vec3> corners(const std::vector<Vec3>& path, Vec3 at) {
    const auto scene = building();
    Planners planners(*scene);
    test::LoneMover robot(planners, 0, at, body);
    Waypoints model{.path = path};
    std::vector<Vec3> ends{at};
    const Legs none;
    while (true) {
        Mover mover = robot.mover(none);
        const Step step = model.next_leg(mover);
        if (std::holds_alternative<Blocked>(step)) return {};
        if (std::holds_alternative<AtRest>(step)) return ends;
        robot.leg = std::get<Leg>(step);
        ends.push_back(robot.leg.to);
    }
}

}  // namespace

TEST_CASE("storeys: on stairs a robot moves at its speed along the sloped (3D) path") {
    const auto scene = building();
    Network net({.scene = scene});
    const NodeId robot = net.add({.name = "R",
                                  .at = {1, 1, 0},
                                  .radius = body,
                                  .move = Waypoints{.path = {{5, 1, 3}, {7, 1, 3}}, .speed = {2}}});
    // The stairs are 3-4-5: 5 m take 2.5 s.
    net.run_until(start_of_run + 1s);
    CHECK(near(net.position(robot), {1 + 1.6, 1, 1.2}));
    net.run_until(start_of_run + 2500ms);
    CHECK(near(net.position(robot), {5, 1, 3}));
    net.run_until(start_of_run + 3s);
    CHECK(near(net.position(robot), {6, 1, 3}));
    net.run_until(start_of_run + 10s);
    CHECK(net.position(robot) == Vec3{7, 1, 3});
}

TEST_CASE("storeys: a path goes around the walls of its storey, and straight along stairs") {
    // Below the door is at the right, above at the left.
    const auto below = corners({{1, 4, 0}}, {1, 1, 0});
    REQUIRE(below.size() > 2);
    for (const Vec3 p : below) CHECK(p.z == 0);
    CHECK(below[1].x > 7.5);
    const auto above = corners({{9, 4, 3}}, {9, 1, 3});
    REQUIRE(above.size() > 2);
    for (const Vec3 p : above) CHECK(p.z == 3);
    CHECK(above[1].x < 2.5);
    CHECK(corners({{5, 1, 3}}, {1, 1, 0}) == std::vector<Vec3>{{1, 1, 0}, {5, 1, 3}});
    // Through the door below, up, and through the door above.
    const auto all = corners({{9, 4, 0}, {5, 4, 3}, {5, 1, 3}}, {9, 1, 0});
    REQUIRE(all.size() > 4);
    CHECK(all[1] == Vec3{9, 4, 0});
    CHECK(all[2] == Vec3{5, 4, 3});
}

TEST_CASE("storeys: no path leads over stairs into a wall or off the map") {
    CHECK(corners({{5, 4, 3}}, {5, 1, 0}).empty());        // the wall below stands in the way
    CHECK(corners({{5, 2.5, 3}}, {9, 2.5, 0}).empty());    // it would end in the wall above
    CHECK(corners({{-1, 1, 3}}, {1, 1, 0}).empty());       // beyond the map
    CHECK_FALSE(corners({{9, 1, 3}}, {9, 4, 0}).empty());  // through the door below
    const auto scene = building();
    Planners planners(*scene);
    CHECK(planners.has_way({9, 4, 0}, {9, 1, 3}, body));
    CHECK(planners.has_way({1, 1, 0}, {1, 4, 0}, body));
    CHECK_FALSE(planners.has_way({5, 1, 0}, {5, 4, 3}, body));
}

TEST_CASE(
    "storeys: for a timed path, the sloped (3D) length of stairs counts, not their length on the "
    "map") {
    const auto scene = building();
    Network net({.scene = scene});
    const NodeId robot = net.add({.name = "R",
                                  .at = {1, 1, 0},
                                  .radius = body,
                                  .move = Waypoints{.timed = {{0s, {1, 1, 0}}, {10s, {5, 1, 3}}}}});
    net.run_until(start_of_run + 4s);
    CHECK(near(net.position(robot), {1 + 1.6, 1, 1.2}));
}

TEST_CASE(
    "storeys: the range finder of a movement model sees only the walls of the robot's storey") {
    const auto scene = building();
    Planners planners(*scene);
    const Legs none;
    const auto ahead = [&](Vec3 at) {
        const test::LoneMover robot(planners, 0, at, body);
        Mover mover = robot.mover(none);
        mover.heading = 3.14159265358979323846 / 2;
        return LookRound(mover, Meters{9}).way(0);
    };
    CHECK(near(ahead({1, 1, 0}), 1));
    CHECK(near(ahead({1, 1, 3}), 9));
    CHECK(near(ahead({9, 1, 3}), 1));
}

TEST_CASE("storeys: robots with random movements stay on their storey and enter no walls") {
    const auto scene = building();
    Planners planners(*scene);
    Wander wander{};
    RandomWaypoint waypoints{.start = StartState::here};
    const auto check = [&](auto& model, std::uint64_t key) {
        test::LoneMover robot(planners, key, {9, 1, 3}, body);
        bool crossed = false;
        for (int i = 0; i < 300; ++i) {
            REQUIRE(robot.walk(model));
            CHECK(robot.leg.to.z == 3);
            CHECK(scene->passable(robot.leg.from, robot.leg.to, body));
            crossed = crossed || (robot.leg.to.y > 3 && robot.leg.to.x < 8);
        }
        CHECK(crossed);  // where below would be no way without the other door
    };
    check(wander, 3);
    check(waypoints, 4);
}

}  // namespace mobility_storeys_test
