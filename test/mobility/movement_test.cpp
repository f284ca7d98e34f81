// SPDX-License-Identifier: MIT
#include "mobility/movement.hpp"

#include "mobility/planners.hpp"
#include "mobility/waypoints.hpp"
#include "scene/scene.hpp"
#include "sim/legs.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <utility>

namespace movement_test {
using namespace rovernet;

namespace {

/// Asks a movement of a robot at (1, 2) m for its next leg, and expects one.
Leg leg_of(Movement& movement) {
    const Scene scene;
    Planners planners(scene);
    const Legs legs;
    Mover mover{.now = start_of_run,
                .position = {1, 2, 0},
                .radius = {0.2},
                .planners = planners,
                .legs = legs,
                .heading = 3};
    return std::get<Leg>(movement.next_leg(mover));
}

bool stands(const Leg& leg) {
    return leg.end == never && leg.from == Vec3{1, 2, 0} && leg.to == leg.from &&
           leg.velocity == Vec3{} && leg.heading == 3;
}

}  // namespace

TEST_CASE("movement: a default-constructed movement stands still, and so do its copies") {
    Movement none;
    Movement copy = none;
    Movement fixed = Fixed{};
    CHECK(stands(leg_of(none)));
    CHECK(stands(leg_of(copy)));
    CHECK(stands(leg_of(fixed)));
    CHECK(sizeof(Movement) == sizeof(void*));
}

TEST_CASE("movement: a movement stands still after its content is moved away (std::move)") {
    Movement goal = ToGoal{.to = {9, 2, 0}};
    Movement taken = std::move(goal);
    CHECK(leg_of(taken).to == Vec3{9, 2, 0});
    CHECK(stands(leg_of(goal)));
    taken = Fixed{};
    CHECK(stands(leg_of(taken)));
    taken = Movement(ToGoal{.to = {5, 2, 0}});
    CHECK(leg_of(taken).to == Vec3{5, 2, 0});
}

TEST_CASE("movement: after a copy is made, the original continues without any effect on the copy") {
    Movement goal = Waypoints{.path = {{9, 2, 0}, {9, 9, 0}}};
    Movement copy = goal;
    CHECK(leg_of(goal).to == Vec3{9, 2, 0});
    CHECK(leg_of(copy).to == Vec3{9, 2, 0});
}

TEST_CASE(
    "movement: a motion keeps the given speed, even if it would end after the largest clock time") {
    const MetersPerSecond slow{0.1};
    for (const double metres : {1e7, 1e9}) {  // 3 and 317 years
        CAPTURE(metres);
        Movement goal = ToGoal{.to = {1 + metres, 2, 0}, .speed = slow};
        const Leg leg = leg_of(goal);
        CHECK(leg.velocity.x == doctest::Approx(slow.value).epsilon(1e-12));
        const Time year = start_of_run + from_seconds(31'556'952);
        CHECK(leg.position(year).x == doctest::Approx(1 + 3'155'695.2).epsilon(1e-12));
        CHECK(leg.end >= start_of_run + from_seconds(std::min(metres / slow.value, 9e9)));
    }
}

}  // namespace movement_test
