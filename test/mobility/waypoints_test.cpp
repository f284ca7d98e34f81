// SPDX-License-Identifier: MIT
#include "mobility/waypoints.hpp"

#include "mobility/planners.hpp"
#include "network/network.hpp"
#include "sim/legs.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace waypoints_test {
using namespace rovernet;
using test::drawn_map;

namespace {

using namespace std::chrono_literals;

/// A few roundings of coordinates up to 1 km.
constexpr double tolerance = 1e-9;  // [m]

bool near(Vec3 a, Vec3 b) { return distance(a, b) <= tolerance; }

/// What a robot did.
struct Diary {
    std::vector<Moved> moves{};
    std::vector<Arrived> arrivals{};
    std::vector<NoWay> no_ways{};

    KindMask kinds() const { return kind_of<Moved>() | kind_of<Arrived>() | kind_of<NoWay>(); }
    void on(const Record& record, const RecordContext&) {
        if (const auto* m = std::get_if<Moved>(&record)) moves.push_back(*m);
        if (const auto* a = std::get_if<Arrived>(&record)) arrivals.push_back(*a);
        if (const auto* n = std::get_if<NoWay>(&record)) no_ways.push_back(*n);
    }
};

/// One robot in a world of its own.
struct Walk {
    explicit Walk(Movement movement, Vec3 at = {}, std::shared_ptr<const Scene> scene = nullptr)
        : net({.scene = std::move(scene)}) {
        net.add_sink(diary);
        net.add({.name = {}, .at = at, .move = std::move(movement)});
    }
    Vec3 at(Duration t) {
        net.run_until(start_of_run + t);
        return net.position({0});
    }
    std::shared_ptr<Diary> diary = std::make_shared<Diary>();
    Network net;
};

std::shared_ptr<const Scene> scene_of(const std::vector<std::string>& rows) {
    return std::make_shared<Scene>(drawn_map(rows));
}

}  // namespace

TEST_CASE("waypoints: the time for a path is its length divided by the speed") {
    Walk walk(Waypoints{.path = {{10, 0, 0}, {10, 5, 0}}, .speed = {2}});
    CHECK(near(walk.at(1s), {2, 0, 0}));
    CHECK(near(walk.at(4500ms), {9, 0, 0}));
    CHECK(walk.at(5s) == Vec3{10, 0, 0});
    CHECK(near(walk.at(6s), {10, 2, 0}));
    CHECK(walk.diary->arrivals.empty());
    CHECK(walk.at(7500ms) == Vec3{10, 5, 0});
    REQUIRE(walk.diary->arrivals.size() == 1);
    CHECK(walk.diary->arrivals[0].time == start_of_run + 7500ms);
    CHECK(walk.at(1h) == Vec3{10, 5, 0});
    CHECK(walk.diary->arrivals.size() == 1);
}

TEST_CASE("waypoints: if times are given, a robot is at each position at the given time") {
    const std::vector<TimedPoint> table{
        {3s, {7, 0, 0}}, {4s, {7, 1, 0}}, {7'777'777'777ns, {-3, 2, 1}}};
    Walk walk(Waypoints{.timed = table});
    CHECK(near(walk.at(1500ms), {3.5, 0, 0}));
    for (const auto& [time, place] : table) {
        CHECK(walk.at(time - start_of_run) == place);
    }
    REQUIRE(walk.diary->arrivals.size() == 1);
    CHECK(walk.diary->arrivals[0].time == table.back().time);
}

TEST_CASE(
    "waypoints: if a position is given twice in a row, the robot rests there until the later "
    "time") {
    Walk walk(Waypoints{.timed = {{2s, {2, 0, 0}}, {5s, {2, 0, 0}}, {6s, {3, 0, 0}}}});
    CHECK(walk.at(2s) == Vec3{2, 0, 0});
    CHECK(walk.at(4s) == Vec3{2, 0, 0});
    CHECK(near(walk.at(5500ms), {2.5, 0, 0}));
    CHECK(walk.at(6s) == Vec3{3, 0, 0});
}

TEST_CASE("waypoints: a position whose time has already passed is skipped") {
    Walk walk(Waypoints{.timed = {{2s, {2, 0, 0}}, {1s, {50, 0, 0}}, {4s, {4, 0, 0}}}});
    CHECK(walk.at(2s) == Vec3{2, 0, 0});
    CHECK(near(walk.at(3s), {3, 0, 0}));
    CHECK(walk.at(4s) == Vec3{4, 0, 0});
}

TEST_CASE(
    "waypoints: after the last position with a time, the robot continues at the path's `speed`") {
    Walk walk(Waypoints{.timed = {{2s, {1, 0, 0}}}, .path = {{1, 4, 0}}, .speed = {4}});
    CHECK(walk.at(2s) == Vec3{1, 0, 0});
    CHECK(near(walk.at(2500ms), {1, 2, 0}));
    CHECK(walk.at(3s) == Vec3{1, 4, 0});
}

TEST_CASE(
    "waypoints: legs join without gaps, and each leg's end is its start plus velocity times "
    "duration") {
    test::Draw draw(17);
    for (int run = 0; run < 30; ++run) {
        Waypoints way{.speed = {draw.uniform(0.1, 30)}};
        const auto place = [&] {
            return Vec3{draw.uniform(-500, 500), draw.uniform(-500, 500), draw.uniform(0, 3)};
        };
        for (int i = 1; i < 5; ++i) way.timed.push_back({i * 7s + draw.below(7000) * 1ms, place()});
        for (int i = 0; i < 5; ++i) way.path.push_back(place());
        Walk walk(way, place());
        walk.at(100h);
        const auto& moves = walk.diary->moves;
        REQUIRE(moves.size() == 9);
        for (std::size_t i = 0; i < moves.size(); ++i) {
            const Leg& leg = moves[i].leg;
            CHECK(moves[i].time == leg.start);
            CHECK(near(leg.from + seconds(leg.end - leg.start) * leg.velocity, leg.to));
            if (i == 0) continue;
            CHECK(leg.start == moves[i - 1].leg.end);
            CHECK(leg.from == moves[i - 1].leg.to);
        }
        for (std::size_t i = 0; i < 4; ++i) CHECK(moves[i].leg.end == way.timed[i].time);
        for (std::size_t i = 4; i < 9; ++i) {
            // The end is rounded to a nanosecond, which the velocity follows.
            constexpr double relative = 1e-6;
            const double speed = std::sqrt(dot(moves[i].leg.velocity, moves[i].leg.velocity));
            CHECK(std::abs(speed - way.speed.value) <= relative * way.speed.value);
        }
        CHECK(walk.diary->arrivals.size() == 1);
    }
}

TEST_CASE("waypoints: to a goal behind a wall the robot goes around the wall") {
    const auto scene = scene_of({
        "...........",
        ".....#.....",
        ".....#.....",
        ".....#.....",
        ".....#.....",
    });
    Walk walk(ToGoal{.to = {9.5, 0.5}, .speed = {1}}, {1.5, 0.5}, scene);
    walk.at(1h);
    CHECK(walk.net.position({0}) == Vec3{9.5, 0.5});
    CHECK(walk.diary->no_ways.empty());
    REQUIRE(walk.diary->moves.size() >= 2);
    double length = 0;
    for (const auto& [time, node, leg] : walk.diary->moves) {
        CHECK(scene->passable(leg.from, leg.to, 0.2_m));
        length += distance(leg.from, leg.to);
    }
    CHECK(length > 11);  // over the top of the wall, 2 hypot(3.5, 3.5) + 1 = 10.9 m for a point
    REQUIRE(walk.diary->arrivals.size() == 1);
    // One nanosecond of rounding for each leg.
    const double slack = 1e-9 * static_cast<double>(walk.diary->moves.size());
    CHECK(std::abs(seconds(walk.diary->arrivals[0].time) - length) <= slack);
}

TEST_CASE("waypoints: also on a detour around a wall, given times are met to the nanosecond") {
    const auto scene = scene_of({"...........", ".....#.....", ".....#.....", ".....#....."});
    Walk walk(Waypoints{.timed = {{20s, {9.5, 0.5}}, {40s, {1.5, 0.5}}}}, {1.5, 0.5}, scene);
    CHECK(walk.at(20s) == Vec3{9.5, 0.5});
    CHECK(walk.diary->moves.size() >= 2);
    CHECK(walk.at(40s) == Vec3{1.5, 0.5});
    REQUIRE(walk.diary->arrivals.size() == 1);
    CHECK(walk.diary->arrivals[0].time == start_of_run + 40s);
}

TEST_CASE(
    "waypoints: if there is no path to the goal, the robot reports this and stays where it is") {
    const auto scene = scene_of({".....#.....", ".....#.....", ".....#....."});
    Walk walk(ToGoal{.to = {9.5, 0.5, 0}}, {1.5, 0.5}, scene);
    CHECK(walk.at(1min) == Vec3{1.5, 0.5});
    REQUIRE(walk.diary->no_ways.size() == 1);
    CHECK(walk.diary->no_ways[0].time == start_of_run);
    CHECK(walk.diary->no_ways[0].goal == Vec3{9.5, 0.5, 0});
    CHECK(walk.diary->arrivals.empty());
}

TEST_CASE("waypoints: a goal inside a wall or off the map is refused") {
    for (const Vec3 goal : {Vec3{5.5, 0.5}, Vec3{50, 0.5}}) {
        Walk walk(ToGoal{.to = goal}, {1.5, 0.5}, scene_of({"...........", ".....#....."}));
        walk.at(1min);
        CHECK(walk.diary->no_ways.size() == 1);
    }
}

TEST_CASE("waypoints: if the path is empty or ends where the robot is, the robot arrives at once") {
    for (const auto& path : {std::vector<Vec3>{}, {{3, 4, 0}}, {{3, 4, 0}, {3, 4, 0}}}) {
        Walk walk(Waypoints{.path = path}, {3, 4, 0});
        CHECK(walk.at(1min) == Vec3{3, 4, 0});
        REQUIRE(walk.diary->arrivals.size() == 1);
        CHECK(walk.diary->arrivals[0].time == start_of_run);
        CHECK(walk.diary->moves.size() == 1);
    }
}

TEST_CASE("waypoints: a speed that is not > 0 is refused") {
    const Scene field;
    Planners planners(field);
    const Legs legs;
    Mover mover{start_of_run, {}, 0.2_m, planners, legs};
    const double inf = std::numeric_limits<double>::infinity();
    for (const double speed : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), inf}) {
        CAPTURE(speed);
        Waypoints way{.path = {{1, 0, 0}}, .speed = {speed}};
        CHECK_THROWS_AS(way.next_leg(mover), std::invalid_argument);
        Movement goal = ToGoal{.to = {1, 0, 0}, .speed = {speed}};
        CHECK_THROWS_AS(goal.next_leg(mover), std::invalid_argument);
    }
}

TEST_CASE("waypoints: a piece of movement lasts at least a nanosecond at any speed") {
    Walk walk(Waypoints{.path = {{1e-6, 0, 0}, {2e-6, 0, 0}}, .speed = {1e9}});
    CHECK(walk.at(1s) == Vec3{2e-6, 0, 0});
    for (const auto& move : walk.diary->moves) CHECK(move.leg.end > move.leg.start);
}

}  // namespace waypoints_test
