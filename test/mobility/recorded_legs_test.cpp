// SPDX-License-Identifier: MIT
#include "mobility/recorded_legs.hpp"

#include "network/network.hpp"
#include "scene/scene.hpp"
#include "test/mobility/lone_mover.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <vector>

namespace recorded_legs_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::LoneMover;

namespace {

Leg leg(Duration start, Duration end, Vec3 from, Vec3 velocity) {
    Leg leg{.start = start_of_run + start, .end = start_of_run + end, .from = from};
    leg.velocity = velocity;
    leg.to = from + seconds(end - start) * velocity;
    return leg;
}

}  // namespace

TEST_CASE(
    "recorded legs: a robot moves along each leg (piece of movement), and rests between two legs") {
    const Scene scene;
    Planners planners(scene);
    LoneMover robot(planners);
    RecordedLegs model({leg(0s, 4s, {}, {1, 0}), leg(6s, 8s, {4, 0}, {0, 2})});
    REQUIRE(robot.walk(model));
    CHECK(robot.leg.to == Vec3{4, 0});
    REQUIRE(robot.walk(model));
    CHECK(robot.leg.velocity == Vec3{});
    CHECK(robot.leg.end == start_of_run + 6s);
    REQUIRE(robot.walk(model));
    CHECK(robot.leg.to == Vec3{4, 4});
    CHECK_FALSE(robot.walk(model));
}

TEST_CASE(
    "recorded legs: a leg that was replaced before its end is cut where the next leg starts") {
    const Scene scene;
    Planners planners(scene);
    LoneMover robot(planners);
    RecordedLegs model({leg(0s, 10s, {}, {1, 0}), leg(3s, 5s, {3, 0}, {0, 1})});
    REQUIRE(robot.walk(model));
    CHECK(robot.leg.end == start_of_run + 3s);
    CHECK(robot.leg.to == Vec3{3, 0});
    CHECK_THROWS_AS(RecordedLegs({leg(3s, 5s, {}, {}), leg(3s, 6s, {}, {})}),
                    std::invalid_argument);
}

TEST_CASE("recorded legs: a robot moves as recorded, whatever its turn rate and top speed") {
    Network net;
    const NodeId robot =
        net.add({.name = "r",
                 .at = {},
                 .move = RecordedLegs({leg(0s, 4s, {}, {1, 0}), leg(4s, 8s, {4, 0}, {0, 1})}),
                 .heading = {1},
                 .top_speed = {0.5},
                 .turn_rate = RadiansPerSecond{0.1}});
    net.run_for(6s);
    CHECK(distance(net.position(robot), {4, 2}) < 1e-9);
}

}  // namespace recorded_legs_test
