// SPDX-License-Identifier: MIT
#include "traces/ns2/ns2_motion.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <vector>

namespace ns2_motion_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

constexpr NodeId robot{0};

Time at(Duration t) { return start_of_run + t; }

/// `M` line of the robot.
void go(Ns2Motion& motion, Duration t, Vec3 from, Vec3 to, double speed) {
    motion.begins(robot,
                  leg_of({.time = at(t), .node = robot, .from = from, .to = to, .speed = speed}));
}

/// Where its legs have the robot.
Vec3 place(const Ns2Motion& motion, Duration t) {
    Vec3 place{};
    for (const Leg& leg : motion.legs(robot)) {
        if (leg.start <= at(t)) place = leg.position(at(t));
    }
    return place;
}

void check_place(const Ns2Motion& motion, Duration t, Vec3 expected, double tolerance = 1e-9) {
    CAPTURE(seconds(t));
    const Vec3 found = place(motion, t);
    CAPTURE(found.x);
    CAPTURE(found.y);
    CHECK(distance(found, expected) <= tolerance);
}

}  // namespace

TEST_CASE(
    "ns-2 motion: a robot rests before its first movement, goes to the goal, and rests there") {
    Ns2Motion motion;
    go(motion, 2s, {1, 2}, {9, 2}, 4);
    CHECK(motion.knows(robot));
    CHECK_FALSE(motion.knows(NodeId{1}));
    CHECK(motion.legs(NodeId{1}).empty());
    check_place(motion, 0s, {1, 2});
    check_place(motion, 2s, {1, 2});
    check_place(motion, 3s, {5, 2});
    check_place(motion, 4s, {9, 2});
    check_place(motion, 100s, {9, 2});
    CHECK(motion.legs(robot).back().heading == 0);
}

TEST_CASE(
    "ns-2 motion: a movement that ends early is corrected by the start position of the next one") {
    Ns2Motion motion;
    go(motion, 0s, {}, {100, 0}, 2.5);           // in truth at 2.503 m/s
    go(motion, 20s, {50.06, 0}, {50.06, 9}, 1);  // and turned here
    check_place(motion, 10s, {25.03, 0});
    check_place(motion, 20s, {50.06, 0});
    check_place(motion, 21s, {50.06, 1});
}

TEST_CASE(
    "ns-2 motion: a movement with enough time ends at its goal, wherever the next one begins") {
    Ns2Motion motion;
    go(motion, 0s, {}, {10, 0}, 1);
    go(motion, 15s, {10, 0}, {10, 5}, 1);
    check_place(motion, 14s, {10, 0});
    go(motion, 30s, {70, 70}, {70, 70}, 0);  // put there
    check_place(motion, 29s, {10, 5});
    check_place(motion, 31s, {70, 70});
}

TEST_CASE("ns-2 motion: positions in packet lines refine the rounded speed of a movement") {
    Ns2Motion motion;
    go(motion, 0s, {}, {100, 0}, 2.5);
    for (int i = 1; i <= 30; ++i) motion.is_at(robot, at(i * 1s), {2.503 * i, 0});
    check_place(motion, 30s, {75.09, 0});
    check_place(motion, 29500ms, {73.8385, 0}, 1e-6);
    check_place(motion, 60s, {100, 0});
    motion.is_at(robot, at(60s), {100, 0});
    go(motion, 61s, {100, 0}, {0, 0}, 2.5);
    check_place(motion, 60500ms, {100, 0});
}

TEST_CASE("ns-2 motion: without M lines (movements), robots go straight between known positions") {
    Ns2Motion motion;
    motion.is_at(robot, at(1s), {5, 5});
    motion.is_at(robot, at(10s), {5, 5});  // it rested until here
    motion.is_at(robot, at(12s), {9, 5});
    motion.is_at(robot, at(14s), {9, 5});
    motion.is_at(robot, at(15s), {9, 7});
    check_place(motion, 9s, {5, 5});
    check_place(motion, 11s, {7, 5});
    check_place(motion, 13s, {9, 5});
    check_place(motion, 14500ms, {9, 6});
    check_place(motion, 99s, {9, 7});
}

TEST_CASE("ns-2 motion: movements are sorted by time, whatever the order of the lines") {
    Ns2Motion motion;
    motion.is_at(robot, at(1s), {});
    motion.is_at(robot, at(1s), {4, 0});
    go(motion, 1s, {4, 0}, {5, 0}, 1);
    motion.is_at(robot, at(3s), {8, 0});
    go(motion, 2999995us, {8, 0}, {9, 0}, 1);  // rounded down
    go(motion, 500ms, {8, 0}, {7, 0}, 1);      // another file begins
    motion.is_at(robot, at(0s), {1, 1});
    const std::vector<Leg> legs = motion.legs(robot);
    for (std::size_t i = 1; i < legs.size(); ++i) CHECK(legs[i - 1].start < legs[i].start);
    check_place(motion, 10s, {7, 0});
}

}  // namespace ns2_motion_test
