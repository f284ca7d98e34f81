// SPDX-License-Identifier: MIT
// Robots at doors that close and open.
#include "mobility/driven.hpp"
#include "mobility/follow.hpp"
#include "mobility/follow_wall.hpp"
#include "mobility/gauss_markov.hpp"
#include "mobility/patrol.hpp"
#include "mobility/random_direction.hpp"
#include "mobility/random_walk.hpp"
#include "mobility/random_waypoint.hpp"
#include "mobility/straight.hpp"
#include "mobility/wander.hpp"
#include "mobility/waypoints.hpp"
#include "network/network.hpp"
#include "scene/closed_doors.hpp"
#include "scene/doors.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace motion_doors_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

constexpr double before = 2e-6;    // [m] that robots stop before a door, at most
constexpr double rounding = 1e-9;  // [m]

bool near(Vec3 a, Vec3 b, double within = before) { return distance(a, b) <= within; }

/// Two rooms, and a gap of 2 m between them at x = 6 ... 7, y = 3 ... 5.
std::shared_ptr<const Scene> rooms() {
    return std::make_shared<const Scene>(test::drawn_map({"#############",  //
                                                          "#     #     #",  //
                                                          "#     #     #",  //
                                                          "#           #",  //
                                                          "#           #",  //
                                                          "#     #     #",  //
                                                          "#     #     #",  //
                                                          "#############"}));
}

/// Door in the gap, 0.2 m thick.
Door door(std::vector<Duration> closes, std::vector<Duration> opens) {
    return {.from = {6.5, 3, 0},
            .to = {6.5, 5, 0},
            .thickness = 0.2_m,
            .closes = std::move(closes),
            .opens = std::move(opens)};
}

struct Diary {
    std::vector<Moved> moves = {};
    std::vector<Arrived> arrivals = {};
    std::size_t no_ways = 0;
    KindMask kinds() const { return kind_of<Moved>() | kind_of<Arrived>() | kind_of<NoWay>(); }
    void on(const Record& record, const RecordContext&) {
        if (const auto* m = std::get_if<Moved>(&record)) moves.push_back(*m);
        if (const auto* a = std::get_if<Arrived>(&record)) arrivals.push_back(*a);
        if (std::holds_alternative<NoWay>(record)) ++no_ways;
    }
};

/// A network in the two rooms, and what moves there.
struct House {
    Network network;
    std::shared_ptr<Diary> diary = std::make_shared<Diary>();

    explicit House(const std::vector<Door>& doors) : network(settings(doors)) {
        network.add_sink(diary);
    }
    static NetworkSettings settings(const std::vector<Door>& doors) {
        NetworkSettings settings;
        settings.scene = rooms();
        settings.scene_changes = scene_changes(settings.scene, doors);
        return settings;
    }
    NodeId add(Vec3 at, Movement move) {
        return network.add({.name = {}, .at = at, .radius = 0.3_m, .move = std::move(move)});
    }
    Vec3 at(Duration t, NodeId node) {
        network.run_until(start_of_run + t);
        return network.position(node);
    }
};

}  // namespace

TEST_CASE("doors: a moving robot stops before a closed door, and continues when the door opens") {
    House house({door({1s}, {10s})});
    const NodeId a = house.add({2, 4, 0}, ToGoal{.to = {11, 4, 0}, .speed = {1}});
    // The door's side is at 6.4 m; the body has 0.3 m.
    CHECK(near(house.at(2s, a), {4, 4, 0}, rounding));
    CHECK(near(house.at(4s, a), {6, 4, 0}, rounding));
    CHECK(near(house.at(5s, a), {6.1, 4, 0}));
    CHECK(house.network.scene().clearance(house.network.position(a)) >= 0.3);
    CHECK(near(house.at(10s, a), {6.1, 4, 0}));
    CHECK(near(house.at(11s, a), {7.1, 4, 0}));
    CHECK(near(house.at(20s, a), {11, 4, 0}, 0));
    REQUIRE(house.diary->arrivals.size() == 1);
    CHECK(std::abs(seconds(house.diary->arrivals[0].time) - 14.9) < before);
    CHECK(house.diary->no_ways == 0);
    // It sets off, is stopped, stands, and goes on.
    REQUIRE(house.diary->moves.size() == 4);
    CHECK(house.diary->moves[1].time == start_of_run + 1s);
    CHECK(house.diary->moves[3].time == start_of_run + 10s);
    CHECK(house.diary->moves[3].leg.velocity == house.diary->moves[0].leg.velocity);
}

TEST_CASE("doors: paths are planned as if all doors were open, so a robot waits at a closed door") {
    House house({door({0s}, {20s})});
    const NodeId a = house.add({2, 1.5, 0}, Waypoints{.path = {{2, 4, 0}, {11, 4, 0}, {11, 2, 0}}});
    CHECK(near(house.at(15s, a), {6.1, 4, 0}));
    CHECK(near(house.at(40s, a), {11, 2, 0}, 0));
    CHECK(house.diary->arrivals.size() == 1);
}

TEST_CASE("doors: a door that opens before the robot arrives does not stop it") {
    House house({door({1s}, {3s})});
    const NodeId a = house.add({2, 4, 0}, ToGoal{.to = {11, 4, 0}, .speed = {1}});
    CHECK(near(house.at(5s, a), {7, 4, 0}));
    CHECK(near(house.at(9s + 1us, a), {11, 4, 0}, rounding));
    CHECK(house.diary->arrivals.size() == 1);
}

TEST_CASE("doors: a robot that passes two doors waits at the first, then at the second") {
    Door second = door({0s}, {12s});
    second.from.x = second.to.x = 9;
    second.from.y = 1;
    second.to.y = 7;
    House house({door({1s}, {8s}), second});
    const NodeId a = house.add({2, 4, 0}, ToGoal{.to = {11, 4, 0}, .speed = {1}});
    CHECK(near(house.at(7s, a), {6.1, 4, 0}));
    CHECK(near(house.at(9s, a), {7.1, 4, 0}));
    CHECK(near(house.at(11s, a), {8.6, 4, 0}, 2 * before));
    CHECK(near(house.at(13s, a), {9.6, 4, 0}, 2 * before));
    CHECK(near(house.at(20s, a), {11, 4, 0}, 0));
}

TEST_CASE("doors: a robot that waits at a door is not affected by changes of another door") {
    Door other = door({6s, 8s}, {7s, 9s});
    other.from = {9, 1, 0};
    other.to = {9, 2, 0};
    House house({door({1s}, {20s}), other});
    const NodeId a = house.add({2, 4, 0}, ToGoal{.to = {11, 4, 0}, .speed = {1}});
    CHECK(near(house.at(15s, a), {6.1, 4, 0}));
    CHECK(house.diary->moves.size() == 3);
    CHECK(near(house.at(30s, a), {11, 4, 0}, 0));
}

TEST_CASE("doors: a robot in the way of a closing door stands until the door opens") {
    House house({door({4s}, {10s})});
    const NodeId a = house.add({2, 4, 0}, ToGoal{.to = {11, 4, 0}, .speed = {1}});
    const NodeId b = house.add({6.5, 3.5, 0}, Fixed{});
    CHECK(near(house.at(4s, a), {6, 4, 0}, rounding));
    house.network.place(a, {6.5, 4, 0});
    house.network.move(a, ToGoal{.to = {11, 4, 0}, .speed = {1}});
    CHECK(near(house.at(9s, a), {6.5, 4, 0}, rounding));
    CHECK(near(house.at(11s, a), {7.5, 4, 0}, rounding));
    CHECK(near(house.at(20s, a), {11, 4, 0}, 0));
    CHECK(house.network.position(b) == Vec3{6.5, 3.5, 0});

    House moving({door({4500ms}, {10s})});
    const NodeId c = moving.add({2, 4, 0}, ToGoal{.to = {11, 4, 0}, .speed = {1}});
    CHECK(near(moving.at(9s, c), {6.5, 4, 0}, rounding));
    CHECK(near(moving.at(11s, c), {7.5, 4, 0}, rounding));
    CHECK(near(moving.at(20s, c), {11, 4, 0}, 0));
}

TEST_CASE("doors: a driven robot stops at a closed door, and continues when the door opens") {
    House house({door({1s}, {10s})});
    const NodeId a = house.add({2, 4, 0}, Driven{.speed = {1}});
    CHECK(near(house.at(6s, a), {6.1, 4, 0}));
    CHECK(near(house.at(11s, a), {7.1, 4, 0}));
    CHECK(near(house.at(30s, a), {11.7, 4, 0}));  // the wall stops it, too
    // A command of its own time ends as it says, whatever stopped the robot.
    House timed({door({1s}, {10s})});
    const NodeId b = timed.add({2, 4, 0}, Driven{.speed = {1}, .until = start_of_run + 8s});
    CHECK(near(timed.at(30s, b), {6.1, 4, 0}));
}

TEST_CASE("doors: robots with recorded movements go through closed doors, as through walls") {
    House house({door({0s}, {})});
    const NodeId a = house.add({2, 4, 0}, Straight{.to = {11, 4, 0}, .speed = {1}});
    CHECK(near(house.at(9s, a), {11, 4, 0}, rounding));
}

TEST_CASE("doors: a robot switched off while it waits goes on once it is on and the door is open") {
    House house({door({1s}, {10s})});
    const NodeId a = house.add({2, 4, 0}, ToGoal{.to = {11, 4, 0}, .speed = {1}});
    house.network.at(start_of_run + 6s, [&] { house.network.switch_off(a); });
    house.network.at(start_of_run + 12s, [&] { house.network.switch_on(a); });
    CHECK(near(house.at(11s, a), {6.1, 4, 0}));
    CHECK(near(house.at(13s, a), {7.1, 4, 0}));
    CHECK(near(house.at(30s, a), {11, 4, 0}, 0));
    // Switched off before it is there, and on again while the door is closed.
    House early({door({1s}, {10s})});
    const NodeId b = early.add({2, 4, 0}, ToGoal{.to = {11, 4, 0}, .speed = {1}});
    early.network.at(start_of_run + 2s, [&] { early.network.switch_off(b); });
    early.network.at(start_of_run + 3s, [&] { early.network.switch_on(b); });
    CHECK(near(early.at(5s, b), {6, 4, 0}, rounding));
    CHECK(near(early.at(9s, b), {6.1, 4, 0}));
    CHECK(near(early.at(30s, b), {11, 4, 0}, 0));
}

TEST_CASE(
    "doors: a turning robot also waits at a door, and a waiting robot follows a new movement") {
    House house({door({0s}, {10s})});
    const NodeId a = house.network.add({.name = "a",
                                        .at = {2, 4, 0},
                                        .radius = 0.3_m,
                                        .move = ToGoal{.to = {11, 4, 0}, .speed = {1}},
                                        .heading = Radians{3},
                                        .turn_rate = RadiansPerSecond{1}});
    const NodeId b = house.add({2, 3.5, 0}, ToGoal{.to = {11, 3.5, 0}, .speed = {1}});
    house.network.at(start_of_run + 6s, [&] {
        house.network.move(b, ToGoal{.to = {2, 6, 0}, .speed = {1}});
    });
    CHECK(near(house.at(9s, a), {6.1, 4, 0}));
    CHECK(near(house.at(20s, b), {2, 6, 0}, 0));
    CHECK(near(house.at(20s, a), {11, 4, 0}, 0));
}

TEST_CASE(
    "doors: with every movement model, robots do not pass closed doors and do not get stuck for "
    "ever") {
    const std::vector<Duration> closes{500ms, 4s, 9s, 16s}, opens{2s, 7s, 12s};
    Door half = door({1s, 6s, 11s}, {3s, 8s, 14s});
    half.from = {3, 1, 0};
    half.to = {4, 5, 0};
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        NetworkSettings of = House::settings({door(closes, opens), half});
        of.seed = seed;
        Network network(std::move(of));
        const Vec3 at{2, 6, 0};
        const auto add = [&](Movement move) {
            network.add({.name = {}, .at = at, .radius = 0.3_m, .move = std::move(move)});
        };
        add(RandomWaypoint{.min_speed = {1}, .max_speed = {3}});
        add(RandomDirection{.min_speed = {1}, .max_speed = {3}});
        add(RandomWalk{.min_speed = {1}, .max_speed = {3}});
        add(GaussMarkov{.mean_speed = {2}});
        add(Wander{.speed = {2}});
        add(FollowWall{.speed = {2}});
        add(Patrol{.path = {{2, 2, 0}, {10, 4, 0}, {10, 6, 0}}, .speed = {2}});
        add(Follow{.leader = NodeId{6}, .distance = 1_m, .speed = {2}});
        add(Driven{.speed = {1}, .turn_rate = {0.2}});
        std::vector<Vec3> last(network.size());
        std::vector<double> way(network.size(), 0);
        const auto doors =
            scene_changes(network.settings().scene, std::vector{door(closes, opens), half});
        constexpr Duration step = 20ms;
        int crossings = 0;
        for (Time t = start_of_run; t <= start_of_run + 18s; t += step) {
            network.run_until(t);
            const SceneChange* then = last_change(doors, t - step);
            for (std::uint32_t i = 0; i < network.size(); ++i) {
                const Vec3 here = network.position({i});
                if (t > start_of_run && then && then->doors) {
                    const bool caught = !then->doors->passable(last[i], last[i], 0.299_m);
                    const bool passed = !then->doors->passable(last[i], here, 0.299_m);
                    crossings += !caught && passed;
                    if (caught && then->time < t - step) CHECK(near(last[i], here, rounding));
                }
                way[i] += t > start_of_run ? distance(last[i], here) : 0;
                last[i] = here;
            }
        }
        CHECK(crossings == 0);
        for (const double each : way) CHECK(each > 1);
    }
}

}  // namespace motion_doors_test
