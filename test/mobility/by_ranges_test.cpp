// SPDX-License-Identifier: MIT
// Robots that go by their range finders: wander and follow_wall.
#include "mobility/follow_wall.hpp"
#include "mobility/planners.hpp"
#include "mobility/wander.hpp"
#include "test/mobility/lone_mover.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace by_ranges_test {
using namespace rovernet;
using test::LoneMover;

namespace {

constexpr Meters radius{0.2};

/// A room of 10 m by 6 m inside its walls, from (1, 1) on.
Scene room() {
    std::vector<std::string> rows(8, "#..........#");
    rows.front() = rows.back() = "############";
    return Scene(test::drawn_map(rows));
}
/// A block of 4 m by 4 m in the midst of a hall, from (10, 10) on.
Scene block() {
    std::vector<std::string> rows(24, "#......................#");
    rows.front() = rows.back() = std::string(24, '#');
    for (std::size_t i = 10; i < 14; ++i) rows[i].replace(10, 4, "####");
    return Scene(test::drawn_map(rows));
}

/// Places of a robot at the ends of its legs, once it has gone `skipped` metres, for a way of
/// `way`.
std::vector<Vec3> places_along(FollowWall model, const Scene& scene, Vec3 from, double skipped,
                               double way) {
    Planners planners(scene);
    LoneMover robot(planners, 0, from, radius);
    std::vector<Vec3> places;
    for (double gone = 0; gone < skipped + way; gone += robot.length()) {
        if (gone >= skipped) places.push_back(robot.leg.to);
        REQUIRE(robot.walk(model));
    }
    return places;
}

/// Area inside of a closed way [m^2], > 0 if it goes round counter-clockwise.
double enclosed(const std::vector<Vec3>& places) {
    double sum = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Vec3 a = places[i], b = places[(i + 1) % places.size()];
        sum += (a.x * b.y - b.x * a.y) / 2;
    }
    return sum;
}

}  // namespace

TEST_CASE("follow_wall: in a room the path is the rectangle half a metre inside the walls") {
    const Scene scene = room();
    const double once_round = 2 * (9 + 5);
    for (const WallSide side : {WallSide::left, WallSide::right}) {
        const FollowWall model{.side = side, .keep = Meters{0.3}, .stride = Meters{0.05}};
        const auto places = places_along(model, scene, {4, 4}, 20, once_round);
        for (const Vec3 p : places) CHECK(std::abs(scene.clearance(p) - 0.5) <= 0.005);
        CHECK(distance(places.front(), places.back()) <= 0.2);
        // With the wall at its left it goes round clockwise.
        const double sign = side == WallSide::left ? -1 : 1;
        CHECK(enclosed(places) == doctest::Approx(sign * 9 * 5).epsilon(0.01));
    }
}

TEST_CASE("follow_wall: around a block the path is a rectangle with rounded corners") {
    const Scene scene = block();
    const FollowWall model{.side = WallSide::right, .keep = Meters{0.8}, .stride = Meters{0.05}};
    const double once_round = 4 * 4 + 2 * std::numbers::pi;  // a metre from it
    const auto places = places_along(model, scene, {12, 16}, 10, once_round);
    for (const Vec3 p : places) CHECK(std::abs(scene.clearance(p) - 1) <= 0.01);
    CHECK(distance(places.front(), places.back()) <= 0.2);
    CHECK(enclosed(places) == doctest::Approx(-(4 * 4 + 4 * 4 + std::numbers::pi)).epsilon(0.01));
}

TEST_CASE("wander: a robot keeps its distance from obstacles and visits all quarters of a room") {
    const Scene scene = room();
    Planners planners(scene);
    const Wander model{.keep = Meters{0.4}, .run = Meters{3}};
    std::vector<bool> quarters(4);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        Wander wander = model;
        LoneMover robot(planners, seed, {6, 4}, radius);
        for (int i = 0; i < 200; ++i) {
            REQUIRE(robot.walk(wander));
            const Leg& leg = robot.leg;
            if (robot.length() == 0) {
                // In place, at its rate but for the shortest turns.
                const double turned = std::abs(leg.turning) * seconds(leg.end - leg.start);
                const double rate = turned > 0.016 ? model.turn_rate.value : turned / 0.01;
                CHECK(std::abs(leg.turning) == doctest::Approx(rate));
                continue;
            }
            CHECK(robot.speed() == doctest::Approx(model.speed.value));
            CHECK(robot.length() <= model.run.value + 1e-9);
            const Vec3 ahead = (0.4 - 1e-5) / robot.length() * (leg.to - leg.from);
            CHECK(scene.passable(leg.from, leg.to + ahead, radius));
            quarters[static_cast<std::size_t>((leg.to.x > 6) + 2 * (leg.to.y > 4))] = true;
        }
    }
    CHECK(std::all_of(quarters.begin(), quarters.end(), [](bool seen) { return seen; }));
}

TEST_CASE("follow_wall: in a narrow corridor a robot moves along the middle, to the end and back") {
    const Scene scene(test::drawn_map({"##############", "#............#", "##############"}, 0.8));
    const FollowWall model{.keep = Meters{0.5}, .stride = Meters{0.05}};
    const auto places = places_along(model, scene, {5, 1.2}, 12, 40);  // twice there and back
    double west = 11.2, east = 0;
    for (const Vec3 p : places) {
        west = std::min(west, p.x);
        east = std::max(east, p.x);
        if (p.x > 1.6 && p.x < 9.6) CHECK(std::abs(p.y - 1.2) <= 0.06);
    }
    CHECK(west < 1.3);
    CHECK(east > 9.9);
}

TEST_CASE(
    "wander: a robot moves in a small room if it fits, and a stuck robot does not hang the run") {
    const Scene closet(test::drawn_map({"###", "#.#", "###"}, 1.2));
    Planners planners(closet);
    for (const double size : {0.2, 0.599, 0.7}) {
        Wander wander{.keep = Meters{0.5}};
        LoneMover robot(planners, 3, {1.8, 1.8}, Meters{size});
        int legs = 0, ways = 0;
        while (robot.leg.end < start_of_run + std::chrono::minutes(1)) {
            REQUIRE(robot.walk(wander));
            ways += robot.length() > 0;
            REQUIRE(++legs < 10'000);
        }
        CHECK((ways > 10) == (size < 0.6));
    }
}

TEST_CASE("wander, follow_wall: a scene without a map is refused") {
    const Scene open_field;
    Planners planners(open_field);
    LoneMover robot(planners);
    Wander wander;
    FollowWall follow;
    CHECK_THROWS_WITH_AS(
        robot.walk(wander),
        "wander: the scene has no map, so there is nothing to avoid; expected a scene with a map",
        std::invalid_argument);
    CHECK_THROWS_WITH_AS(robot.walk(follow),
                         "follow_wall: the scene has no map, so there is no wall to follow; "
                         "expected a scene with a map",
                         std::invalid_argument);
}

}  // namespace by_ranges_test
