// SPDX-License-Identifier: MIT
// What a Network keeps of its robots, and what that takes.
#include "mobility/waypoints.hpp"
#include "models/propagation/disc.hpp"
#include "network/network.hpp"
#include "routing/flood.hpp"
#include "study/validation/flood_bench.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace many_robots_test {
using namespace rovernet;
using namespace std::chrono_literals;

TEST_CASE(
    "many robots: in the flood benchmark, a robot at rest takes less than 164 bytes of memory") {
    // Nearly a power of two: most lists grow to the next.
    const auto row = flood_bench({.cpu_s = 1e-9}, 32'000);
    CHECK(row.receptions > 32'000);
    CHECK(row.bytes_per_node < 164);
}

TEST_CASE(
    "many robots: in the flood benchmark, a random waypoint robot takes less than 350 bytes of "
    "memory") {
    // The queue's buckets that are not full take 16 bytes a robot here; of a million robots one
    // takes 312 bytes in all.
    const auto row =
        flood_bench({.mobility = BenchMobility::random_waypoint, .cpu_s = 1e-9}, 30'000);
    CHECK(row.receptions > 30'000);
    CHECK(row.bytes_per_node < 350);
}

TEST_CASE(
    "many robots: a callback may add robots, and other callbacks of the same robot still run") {
    Network net({.propagation = Disc{.range = {100}}});
    net.route(Flood{});
    net.add({.name = "base", .at = {}});
    const NodeId rover = net.add({.name = "rover", .at = {1, 0, 0}});
    int second = 0, arrivals = 0;
    net.on_receive(rover, [&](const Message&) {
        for (int i = 0; i < 1000; ++i) {
            const NodeId added = net.add({.name = "late" + std::to_string(i),
                                          .at = {0, 200.0 + i, 0},
                                          .move = ToGoal{.to = {0, 200.5 + i, 0}}});
            net.on_arrival(added, [&] { ++arrivals; });
        }
    });
    net.on_receive(rover, [&](const Message& m) { second += m.payload == "go"; });
    net.send({0}, everyone, "go");
    net.run_until(start_of_run + 10s);
    CHECK(second == 1);
    CHECK(arrivals == 1000);
    CHECK(net.size() == 1002);
    CHECK(net.find("late999") == NodeId{1001});
    CHECK(net.name(NodeId{2}) == "late0");
}

TEST_CASE("many robots: reserving memory for robots does not change their movements") {
    std::vector<Vec3> places[2];
    for (const std::size_t reserved : {std::size_t{0}, std::size_t{100}}) {
        Network net;
        net.reserve(reserved);
        for (int i = 0; i < 150; ++i) {
            net.add({.name = {}, .at = {}, .move = ToGoal{.to = {i * 1.0, 9, 0}}});
        }
        net.run_until(start_of_run + 10s);
        for (std::uint32_t i = 0; i < net.size(); ++i) {
            places[reserved > 0].push_back(net.position(NodeId{i}));
        }
    }
    CHECK(places[0] == places[1]);
}

TEST_CASE("many robots: each robot moves at its own top speed") {
    Network net;
    for (int i = 0; i < 9; ++i) {
        net.add({.name = {},
                 .at = {},
                 .move = ToGoal{.to = {100, 0, 0}, .speed = {9}},
                 .top_speed = {1.0 + i / 2 % 3}});
    }
    net.run_until(start_of_run + 10s);
    for (std::uint32_t i = 0; i < net.size(); ++i) {
        CHECK(std::abs(net.position(NodeId{i}).x - 10 * (1.0 + i / 2 % 3)) < 1e-9);
    }
}

TEST_CASE(
    "many robots: a robot placed elsewhere during a turn or while off does not resume its old "
    "movement") {
    Network net;
    const RadiansPerSecond rate{0.5};
    const NodeId robot =
        net.add({.name = "s", .at = {}, .move = ToGoal{.to = {0, 10, 0}}, .turn_rate = rate});
    net.run_until(start_of_run + 1s);
    net.place(robot, {5, 5, 0});  // in the turn
    net.run_until(start_of_run + 60s);
    CHECK(net.position(robot) == Vec3{5, 5, 0});
    net.move(robot, ToGoal{.to = {5, 50, 0}});
    net.run_until(start_of_run + 70s);
    const double turn = (std::acos(0.0) - 0.5) / rate.value;  // [s] what was left of it
    CHECK(distance(net.position(robot), {5, 5 + 10 - turn, 0}) < 1e-6);
    net.switch_off(robot);
    net.place(robot, {7, 7, 0});
    net.switch_on(robot);
    net.run_until(start_of_run + 200s);
    CHECK(net.position(robot) == Vec3{7, 7, 0});
}

TEST_CASE("many robots: a request about a robot that does not exist is refused") {
    Network net;
    net.add({.name = "ada", .at = {}});
    CHECK_THROWS_AS(net.name({1}), std::out_of_range);
    CHECK_THROWS_AS(net.on_arrival({1}, [] {}), std::out_of_range);
    CHECK_THROWS_AS(net.on_link_lost({1}, [](NodeId) {}), std::out_of_range);
    CHECK_THROWS_AS(net.on_receive({1}, [](const Message&) {}), std::out_of_range);
}

TEST_CASE(
    "flood benchmark: with and without recording, the same numbers of frames are received and "
    "lost") {
    for (const std::size_t model :
         {ReceptionTable::place_of<Threshold>(), ReceptionTable::place_of<Collision>()}) {
        const ReceptionTable reception{.model = model};
        const FloodBench plain{.reception = reception, .cpu_s = 1e-9};
        FloodBench recorded{.reception = reception, .cpu_s = 1e-9};
        recorded.recorded = true;
        const auto a = flood_bench(plain, 500), b = flood_bench(recorded, 500);
        CHECK(a.transmissions == b.transmissions);
        CHECK(a.receptions == b.receptions);
        CHECK(a.attempts == b.attempts);
        CHECK((a.attempts > a.receptions) == (reception.as<Collision>() != nullptr));
    }
}

}  // namespace many_robots_test
