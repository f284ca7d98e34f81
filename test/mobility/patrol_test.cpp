// SPDX-License-Identifier: MIT
#include "mobility/patrol.hpp"

#include "test/mobility/lone_mover.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace patrol_test {
using namespace rovernet;
using test::LoneMover;

TEST_CASE("patrol: a robot visits the positions of its path in turn, again and again") {
    const Scene field;
    Planners planners(field);
    LoneMover robot(planners, 0, {0, 0, 1});
    Patrol model{.path = {{3, 0, 1}, {3, 4, 1}, {0, 0, 1}}, .speed = {2}};
    for (int round = 0; round < 10; ++round) {
        for (const Vec3 place : model.path) {
            REQUIRE(robot.walk(model));
            CHECK(robot.leg.to == place);
        }
        CHECK(robot.leg.end == start_of_run + (round + 1) * std::chrono::seconds{6});
    }
}

TEST_CASE("patrol: a robot goes around walls") {
    const Scene map(test::drawn_map({".......", "...#...", "...#...", "...#..."}));
    Planners planners(map);
    LoneMover robot(planners, 0, {0.5, 0.5}, 0.3_m);
    Patrol model{.path = {{6.5, 0.5}, {0.5, 0.5}}};
    int arrivals = 0;
    for (int i = 0; i < 100; ++i) {
        REQUIRE(robot.walk(model));
        REQUIRE(map.passable(robot.leg.from, robot.leg.to, 0.3_m));
        arrivals += robot.leg.to == model.path[0] || robot.leg.to == model.path[1];
    }
    CHECK(arrivals > 20);
    CHECK(arrivals < 50);
}

TEST_CASE("patrol: if there is no path to a position, the robot is blocked") {
    const Scene map(test::drawn_map({"...#...", "...#..."}));
    Planners planners(map);
    const Legs nobody;
    LoneMover robot(planners, 0, {0.5, 0.5});
    Patrol model{.path = {{1.5, 1.5}, {6.5, 0.5}}};
    REQUIRE(robot.walk(model));
    Mover mover = robot.mover(nobody);
    const Step step = model.next_leg(mover);
    REQUIRE(std::holds_alternative<Blocked>(step));
    CHECK(std::get<Blocked>(step).goal == Vec3{6.5, 0.5});
}

TEST_CASE("patrol: if all positions of the path are equal, the robot rests there") {
    const Scene field;
    Planners planners(field);
    const Legs nobody;
    for (const std::size_t places : {1u, 3u}) {
        LoneMover robot(planners, 0, {1, 1});
        Patrol model{.path = std::vector<Vec3>(places, {5, 5})};
        REQUIRE(robot.walk(model));
        Mover mover = robot.mover(nobody);
        CHECK(std::holds_alternative<AtRest>(model.next_leg(mover)));
    }
}

TEST_CASE("patrol: an empty path, or a speed that is not > 0, is refused") {
    const Scene field;
    Planners planners(field);
    LoneMover robot(planners);
    Patrol nowhere;
    CHECK_THROWS_AS(robot.walk(nowhere), std::invalid_argument);
    for (const double speed : {0.0, -1.0, std::nan("")}) {
        Patrol model{.path = {{1, 0}}, .speed = {speed}};
        CHECK_THROWS_AS(robot.walk(model), std::invalid_argument);
    }
    Patrol off{.path = {{std::nan(""), 0}}};
    CHECK_THROWS_AS(robot.walk(off), std::invalid_argument);
}

}  // namespace patrol_test
