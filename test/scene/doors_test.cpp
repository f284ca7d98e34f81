// SPDX-License-Identifier: MIT
#include "scene/doors.hpp"

#include "scene/closed_doors.hpp"
#include "scene/scene.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

namespace scene_doors_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

constexpr double rounding = 1e-12;  // [m]
constexpr Time begin = start_of_run;

std::shared_ptr<const Scene> room() {
    return std::make_shared<const Scene>(test::drawn_map({"####", "#  #", "#  #", "####"}));
}

}  // namespace

TEST_CASE("door: a door is closed from its closing time on, up to the nanosecond before it opens") {
    const Door door{.from = {}, .to = {1, 0, 0}, .closes = {2s, 6s}, .opens = {4s}};
    CHECK_FALSE(door.is_closed(begin));
    CHECK_FALSE(door.is_closed(begin + 2s - 1ns));
    CHECK(door.is_closed(begin + 2s));
    CHECK(door.is_closed(begin + 4s - 1ns));
    CHECK_FALSE(door.is_closed(begin + 4s));
    CHECK(door.is_closed(begin + 6s));
    CHECK(door.is_closed(begin + 6000s));
}

TEST_CASE(
    "door: a closed door acts as a wall of the door's length and thickness, in any direction") {
    const Scene open(test::drawn_map(std::vector<std::string>(40, std::string(40, ' '))));
    for (const double degrees : {0.0, 30.0, 90.0, 135.0, 180.0, 210.0, 270.0, 300.0}) {
        const double turn = degrees * std::numbers::pi / 180;
        const Vec3 along{std::cos(turn), std::sin(turn), 0}, across{-along.y, along.x, 0};
        const Vec3 middle{20, 20, 0};
        const Door door{.from = middle - 1.5 * along,
                        .to = middle + 1.5 * along,
                        .thickness = 0.2_m,
                        .closes = {0s}};
        const Scene closed = with_closed(open, std::vector{door});
        const auto length = [&](Vec3 from, Vec3 to) { return closed.wall_length(from, to); };
        CHECK(std::abs(length(middle - 5 * across, middle + 5 * across) - 0.2) < 1e-9);
        CHECK(std::abs(length(middle - 5 * along, middle + 5 * along) - 3) < 1e-9);
        const Vec3 beside = middle + 1.51 * along;
        CHECK(length(beside - 5 * across, beside + 5 * across) == 0);
        for (const Vec3 corner : door.corners()) {
            CHECK(std::abs(distance(corner, middle) - std::hypot(1.5, 0.1)) < rounding);
        }
        CHECK_FALSE(closed.passable(middle - 5 * across, middle + 5 * across, 0_m));
        const ClosedDoors doors(open, std::vector{door});
        CHECK_FALSE(doors.passable(middle - 5 * across, middle + 5 * across, 0_m));
        CHECK(doors.passable(beside - 5 * across, beside + 5 * across, 0_m));
        CHECK_FALSE(doors.passable(beside - 5 * across, beside + 5 * across, 0.02_m));
        CHECK(closed.lower_left() == open.lower_left());
        CHECK(closed.upper_right() == open.upper_right());
    }
}

TEST_CASE(
    "scene changes: doors that open or close at the same time give a single change of the scene") {
    const auto open = room();
    const Door a{.from = {1, 2, 0}, .to = {2, 2, 0}, .closes = {1s, 5s}, .opens = {3s, 6s}};
    const Door b{.from = {2, 1, 0}, .to = {2, 2, 0}, .closes = {3s}, .opens = {5s}};
    const auto changes = scene_changes(open, std::vector{a, b});
    REQUIRE(changes.size() == 4);
    CHECK(changes[0].time == begin + 1s);
    CHECK(changes[1].time == begin + 3s);
    CHECK(changes[2].time == begin + 5s);
    CHECK(changes[3].time == begin + 6s);
    CHECK(changes[2].scene == changes[0].scene);
    CHECK(changes[1].scene != changes[0].scene);
    CHECK(changes[3].scene == open);
    CHECK_FALSE(changes[3].doors);
    CHECK(last_change(changes, begin + 1s - 1ns) == nullptr);
    CHECK(last_change(changes, begin + 1s) == &changes[0]);
    CHECK(next_change(changes, begin + 1s) == begin + 3s);
    CHECK(next_change(changes, begin + 6s) == never);
    CHECK(scene_changes(open, {}).empty());
}

TEST_CASE("door: in a building with storeys, a door is closed on its own storey only") {
    auto ground = test::drawn_map({"####", "#  #", "#  #", "####"});
    auto upper = ground;
    upper.origin.z = 3;
    const Scene open({ground, upper}, {Material{}}, {Material{.name = "ceiling"}});
    const Door door{.from = {1, 2, 3}, .to = {3, 2, 3}, .closes = {0s}};
    const Scene closed = with_closed(open, std::vector{door});
    REQUIRE(closed.storeys().size() == 2);
    CHECK(closed.storeys().ceilings().size() == 1);
    CHECK_FALSE(closed.passable({2, 1.5, 3}, {2, 2.5, 3}, 0_m));
    CHECK(closed.passable({2, 1.5, 0}, {2, 2.5, 0}, 0_m));
    CHECK(closed.wall_length({2, 1.5, 4}, {2, 2.5, 4}) > 0.04);
    CHECK(closed.wall_length({2, 1.5, 1}, {2, 2.5, 1}) == 0);
    const ClosedDoors doors(open, std::vector{door});
    CHECK_FALSE(doors.passable({2, 1.5, 3}, {2, 2.5, 3}, 0_m));
    CHECK(doors.passable({2, 1.5, 0}, {2, 2.5, 0}, 0_m));
}

TEST_CASE("door: closing a door does not change the walls beside it") {
    test::Draw draw(7);
    const Scene open(test::random_map(draw, 30, 30, 12));
    const Door door{.from = {14, 3, 0}, .to = {16, 5, 0}, .closes = {0s}};
    const Scene closed = with_closed(open, std::vector{door});
    int same = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 a{draw.uniform(0, 30), draw.uniform(6, 30), 0};
        const Vec3 b{draw.uniform(0, 30), draw.uniform(6, 30), 0};
        double sum = 0;
        for (const Crossing& crossing : open.crossings(a, b)) sum += crossing.length;
        same += closed.crossings(a, b).size() == open.crossings(a, b).size();
        CHECK(std::abs(closed.wall_length(a, b) - sum) < 1e-9);
    }
    CHECK(same == 2000);
}

}  // namespace scene_doors_test
