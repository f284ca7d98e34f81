// SPDX-License-Identifier: MIT
#include "mobility/follow.hpp"

#include "mobility/random_direction.hpp"
#include "mobility/waypoints.hpp"
#include "network/network.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace follow_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::drawn_map;

namespace {

/// A few roundings of times to a nanosecond, at some metres a second.
constexpr double tolerance = 1e-6;  // [m]

/// Robot 0 leads, robot 1 follows.
double gap(Network& net, Duration t) {
    net.run_until(start_of_run + t);
    return distance(net.position({0}), net.position({1}));
}

}  // namespace

TEST_CASE("follow: a follower reaches the given distance to a resting leader, and stays there") {
    Network net;
    net.add({.name = "A", .at = {100, 0}});
    net.add({.name = "B", .at = {0, 0}, .move = Follow{.distance = {3}, .speed = {2}}});
    CHECK(std::abs(gap(net, 10s) - 80) < tolerance);
    CHECK(std::abs(gap(net, 60s) - 3) < tolerance);
    CHECK(std::abs(gap(net, 600s) - 3) < tolerance);
    CHECK(net.events() < 700);
}

TEST_CASE(
    "follow: if the leader's speed v is constant, the gap is the distance to keep plus v * "
    "interval") {
    Network net;
    net.add({.name = "A", .at = {10, 0}, .move = ToGoal{.to = {1e4, 0}, .speed = {1.5}}});
    net.add(
        {.name = "B", .at = {0, 0}, .move = Follow{.distance = {3}, .speed = {2}, .every = 500ms}});
    CHECK(std::abs(gap(net, 100s) - (3 + 1.5 * 0.5)) < tolerance);
    CHECK(std::abs(gap(net, 300s) - (3 + 1.5 * 0.5)) < tolerance);
    CHECK(net.events() < 1000);
}

TEST_CASE("follow: behind a faster leader, the gap grows at the difference of the speeds") {
    Network net;
    net.add({.name = "A", .at = {10, 0}, .move = ToGoal{.to = {1e4, 0}, .speed = {3}}});
    net.add({.name = "B", .at = {0, 0}, .move = Follow{.speed = {2}}});
    CHECK(std::abs(gap(net, 100s) - 110) < tolerance);
}

TEST_CASE("follow: a follower stands still while its leader is nearer than the distance to keep") {
    Network net;
    net.add({.name = "A", .at = {1, 0}});
    net.add({.name = "B", .at = {0, 0}, .move = Follow{}});
    net.run_until(start_of_run + 1min);
    CHECK(net.position({1}) == Vec3{0, 0});
}

TEST_CASE("follow: a follower knows the random start position of its leader from the start") {
    Network net;
    net.add({.name = "B", .at = {0, 0}, .move = Follow{.leader = {1}, .every = 1h}});
    const RandomDirection far_off{
        .area = {{1e4, 0}, {2e4, 1e4}}, .min_speed = {1e-3}, .max_speed = {1e-3}};
    net.add({.name = "A", .at = {0, 0}, .move = far_off});
    net.run_until(start_of_run + 100s);
    CHECK(std::abs(distance(net.position({0}), {0, 0}) - 100) < tolerance);
}

TEST_CASE("follow: the distance to the leader is measured along the path around the walls") {
    const auto map = std::make_shared<Scene>(drawn_map({
        ".......",
        "...#...",
        "...#...",
        "...#...",
        "...#...",
    }));
    Network net({.scene = map});
    net.add({.name = "A", .at = {0.5, 0.5}});
    net.add({.name = "B", .at = {6.5, 0.5}, .move = Follow{.distance = {4}}});
    net.run_until(start_of_run + 1min);
    const auto way = shortest_path(*map, net.position({1}), {0.5, 0.5}, 0.2_m);
    REQUIRE(way);
    double length = 0;
    for (std::size_t i = 1; i < way->size(); ++i) length += distance((*way)[i - 1], (*way)[i]);
    CHECK(std::abs(length - 4) < 0.2);  // ways are near the shortest, not the shortest
    CHECK(distance(net.position({1}), {0.5, 0.5}) > 2);
}

TEST_CASE("follow: if there is no path to the leader, the follower stands and tries again later") {
    const auto map =
        std::make_shared<Scene>(drawn_map({"...#....", "...#....", "...#....", "...#...."}));
    Network net({.scene = map});
    net.add({.name = "A", .at = {1, 1}});
    net.add({.name = "B", .at = {5, 1}, .move = Follow{.distance = {1}}});
    net.run_until(start_of_run + 30s);
    CHECK(net.position({1}) == Vec3{5, 1});
    net.at(start_of_run + 31s, [&] { net.move({0}, Fixed{}); });
    net.run_until(start_of_run + 60s);
    CHECK(net.position({1}) == Vec3{5, 1});
    CHECK(net.events() < 100);
}

TEST_CASE(
    "follow: a follower stays at its own height; a robot that is told to follow itself stands "
    "still") {
    Network net;
    net.add({.name = "A", .at = {10, 0, 7}});
    net.add({.name = "B", .at = {0, 0, 1}, .move = Follow{}});
    net.add({.name = "C", .at = {3, 3}, .move = Follow{.leader = {2}}});
    net.run_until(start_of_run + 1min);
    CHECK(distance(net.position({1}), {8, 0, 1}) < tolerance);
    CHECK(net.position({2}) == Vec3{3, 3});
}

TEST_CASE("follow: an unknown leader, or a parameter out of range, is refused") {
    const auto refused = [](Follow model) {
        Network net;
        net.add({.name = "A", .at = {}, .move = model});
        CHECK_THROWS_AS(net.run_until(start_of_run + 1s), std::invalid_argument);
    };
    refused({.leader = {1}});
    refused({.leader = everyone});
    refused({.distance = {-1}});
    refused({.speed = {0}});
    refused({.every = 0s});
}

}  // namespace follow_test
