// SPDX-License-Identifier: MIT
#include "mobility/group.hpp"

#include "mobility/random_direction.hpp"
#include "mobility/waypoints.hpp"
#include "network/network.hpp"
#include "test/mobility/lone_mover.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace group_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::Sample;

namespace {

/// A mean of draws with fixed seeds; one in 16,000 such checks fails by chance with another seed.
constexpr double most_errors = 4;
/// Roundings of places up to 10 km.
constexpr double tolerance = 1e-9;  // [m]

}  // namespace

TEST_CASE(
    "group: at the end of each interval, members are uniformly distributed in a disc near the "
    "leader") {
    Network net;
    net.add({.name = "A", .at = {50, 0}, .move = ToGoal{.to = {1e4, 5e3}, .speed = {3}}});
    for (int i = 0; i < 20; ++i) {
        net.add({.name = {},
                 .at = {0, 3.0 * i},
                 .move = Group{.radius = {8}, .every = 4s, .offset = {-20, 5}}});
    }
    Sample x, y, squares;
    for (int k = 1; k <= 100; ++k) {
        net.run_until(start_of_run + k * 4s);
        for (std::uint32_t i = 1; i <= 20; ++i) {
            const Vec3 off = net.position({i}) - (net.position({0}) + Vec3{-20, 5});
            REQUIRE(dot(off, off) <= 64 + tolerance);
            x.add(off.x);
            y.add(off.y);
            squares.add(dot(off, off));
        }
    }
    CHECK(x.errors_off(0, 4) < most_errors);  // R / 2 for each coordinate
    CHECK(y.errors_off(0, 4) < most_errors);
    CHECK(squares.errors_off(32, 64 / std::sqrt(12.0)) < most_errors);  // uniform in 0 ... R^2
    CHECK(net.events() < 2200);
}

TEST_CASE("group: members expect the leader to stop at the end of its current piece of movement") {
    Network net;
    net.add({.name = "A", .at = {0, 0}, .move = ToGoal{.to = {7, 0}, .speed = {1}}});
    net.add({.name = "B", .at = {0, 0}, .move = Group{.radius = {0}, .every = 5s}});
    net.run_until(start_of_run + 5s);
    CHECK(distance(net.position({1}), {5, 0}) < tolerance);
    net.run_until(start_of_run + 10s);
    CHECK(distance(net.position({1}), {7, 0}) < tolerance);
    net.run_until(start_of_run + 100s);
    CHECK(distance(net.position({1}), {7, 0}) < tolerance);
}

TEST_CASE("group: members know the random start position of their leader") {
    Network net;
    net.add({.name = "B", .at = {0, 0}, .move = Group{.leader = {1}, .radius = {1}}});
    const RandomDirection far_off{
        .area = {{1e4, 0}, {2e4, 1e4}}, .min_speed = {1e-3}, .max_speed = {1e-3}};
    net.add({.name = "A", .at = {0, 0}, .move = far_off});
    net.run_until(start_of_run + 5s);
    CHECK(distance(net.position({0}), net.position({1})) < 1 + tolerance);
}

TEST_CASE("group: a member whose top speed is too low for the interval arrives later") {
    Network net;
    net.add({.name = "A", .at = {60, 0}});
    net.add({.name = "B", .at = {0, 0}, .move = Group{.radius = {2}}, .top_speed = {1}});
    net.run_until(start_of_run + 20s);
    CHECK(std::abs(distance(net.position({1}), {0, 0}) - 20) < 0.1);
    net.run_until(start_of_run + 70s);
    CHECK(distance(net.position({1}), {60, 0}) < 2 + tolerance);
}

TEST_CASE(
    "group: also for a member that joins late, intervals are counted from the start of the run") {
    Network net;
    net.add({.name = "A", .at = {60, 0}});
    const NodeId late = net.add({.name = "B", .at = {0, 0}});
    net.run_until(start_of_run + 12s);
    net.move(late, Group{.radius = {2}});
    net.run_until(start_of_run + 15s);
    CHECK(distance(net.position(late), {60, 0}) < 2 + tolerance);
}

TEST_CASE("group: members go around walls, and choose only reachable positions") {
    const auto map = std::make_shared<Scene>(test::drawn_map({
        ".........",
        "....#....",
        "....#....",
        "....#....",
    }));
    Network net({.scene = map});
    net.add({.name = "A", .at = {1.5, 1.5}});
    for (int i = 0; i < 5; ++i) {
        net.add({.name = {}, .at = {7.5, 0.5 + 0.5 * i}, .move = Group{.radius = {2}}});
    }
    for (int k = 1; k <= 50; ++k) {
        net.run_until(start_of_run + k * 5s);
        for (std::uint32_t i = 1; i <= 5; ++i) {
            REQUIRE(distance(net.position({i}), {1.5, 1.5}) < 2 + tolerance);
            REQUIRE(map->passable(net.position({i}), net.position({i}), 0.2_m));
        }
    }
}

TEST_CASE("group: a member without a path to its leader stands still") {
    const auto map = std::make_shared<Scene>(test::drawn_map({"...#...", "...#..."}));
    Network net({.scene = map});
    net.add({.name = "A", .at = {1, 1}});
    net.add({.name = "B", .at = {5, 1}, .move = Group{.radius = {1}}});
    net.run_until(start_of_run + 1min);
    CHECK(net.position({1}) == Vec3{5, 1});
    CHECK(net.events() < 30);
}

TEST_CASE("group: an unknown leader, or a parameter out of range, is refused") {
    const auto refused = [](Group model) {
        Network net;
        net.add({.name = "A", .at = {}, .move = model});
        CHECK_THROWS_AS(net.run_until(start_of_run + 1s), std::invalid_argument);
    };
    refused({.leader = {1}});
    refused({.radius = {-1}});
    refused({.every = 0s});
}

}  // namespace group_test
