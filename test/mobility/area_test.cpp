// SPDX-License-Identifier: MIT
#include "mobility/area.hpp"

#include "mobility/planners.hpp"
#include "sim/legs.hpp"
#include "test/mobility/lone_mover.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace area_test {
using namespace rovernet;
using test::LoneMover;

namespace {

const Legs nobody;

/// Places for the draws of a model: 20,000 in a hall with one pillar.
struct Hall {
    Scene scene{test::drawn_map({"....", ".#..", "...."})};
    Planners planners{scene};
    LoneMover robot{planners, 3, {0.5, 0.5, 2}, {0.5}};
};

}  // namespace

TEST_CASE("area: an area is clipped to the map, and refused if it does not overlap the map") {
    const Scene map(test::drawn_map({"....", "...."}));
    CHECK(Area({{2, -5}, {50, 1}}, map, "x").lower == Vec3{2, 0});
    CHECK(Area({{2, -5}, {50, 1}}, map, "x").upper == Vec3{4, 1});
    CHECK(Area({}, map, "x").upper == Vec3{4, 2});
    CHECK_THROWS_AS(Area({{5, 0}, {6, 1}}, map, "x"), std::invalid_argument);
    CHECK_THROWS_AS(Area({{4, 0}, {6, 1}}, map, "x"), std::invalid_argument);
}

TEST_CASE(
    "area: on open ground around walls, an area is not clipped, and its free positions are off the "
    "walls") {
    OccupancyGrid grid = test::drawn_map({"#"});
    grid.open_ground = true;
    const Scene scene(grid);
    const Area area({{-5, -4}, {50, 10}}, scene, "x");
    CHECK(area.lower == Vec3{-5, -4});
    CHECK(area.upper == Vec3{50, 10});
    CHECK(Area({{5, 5}, {6, 6}}, scene, "x").lower == Vec3{5, 5});
    CHECK(Area({}, scene, "x").upper == Vec3{1, 1});
    Planners planners(scene);
    LoneMover robot(planners, 3, {3, 3, 0}, {0.5});
    Mover mover = robot.mover(nobody);
    Draws draws;
    bool is_far = false;
    for (int i = 0; i < 1000; ++i) {
        const auto place = area.free_place(mover, draws);
        REQUIRE(place);
        CHECK(scene.clearance(*place) >= 0.5);
        is_far = is_far || place->x > 40;
    }
    CHECK(is_far);
    CHECK(straight_stop(mover, {3000, 3, 0}) == Vec3{3000, 3, 0});
    CHECK(std::abs(straight_stop(robot.mover(nobody), {-1, -1, 0}).x - (1 + 0.5 / std::sqrt(2))) <
          2e-6);
}

TEST_CASE("area: the point where a ray leaves the area lies exactly on its border") {
    const Area area({{-1, 0.1}, {0.3, 0.7}}, Scene{}, "x");
    test::Draw draw(1);
    for (int i = 0; i < 10'000; ++i) {
        const Vec3 p{draw.uniform(-1, 0.3), draw.uniform(0.1, 0.7)};
        const Vec3 along = direction_of(draw.uniform(0, 6.3));
        const Vec3 border = area.exit(p, along);
        REQUIRE(area.contains(border));
        REQUIRE(area.to_border(border) == 0);
        constexpr double rounding = 1e-15;  // of coordinates up to 1
        const Vec3 way = border - p;
        REQUIRE(std::abs(way.x * along.y - way.y * along.x) < rounding);
        REQUIRE(dot(way, along) > -rounding);
    }
    CHECK(area.exit({0, 0.5}, {1, 0}) == Vec3{0.3, 0.5});
    CHECK(area.exit({0, 0.5}, {0, -1}) == Vec3{0, 0.1});
}

TEST_CASE("area: random free positions are uniform, at least a radius from walls, and on the map") {
    Hall hall;
    const Mover mover = hall.robot.mover(nobody);
    const Area area({}, hall.scene, "x");
    Draws draws;
    constexpr int places = 20'000;
    int left = 0;
    for (int i = 0; i < places; ++i) {
        const auto place = area.free_place(mover, draws);
        REQUIRE(place);
        REQUIRE(hall.scene.clearance(*place) >= 0.5 - 1e-9);
        REQUIRE(place->z == 2);
        left += place->x < 0.5;
    }
    // The pillar takes a square of side 1, a strip of 1/2 on each side of it and its rounded
    // corners: 3 + pi / 4 of 12; the strip x < 1/2 is free and has 3/2.
    const double share = 1.5 / (12 - 3 - 3.141592653589793 / 4);
    const double sigma = std::sqrt(share * (1 - share) / places);
    CHECK(std::abs(left / (places + 0.0) - share) < 4 * sigma);
}

TEST_CASE("area: if the robot fits nowhere, there is no free position") {
    const Scene walled(test::drawn_map({"###", "#.#", "###"}));
    Planners planners(walled);
    const LoneMover robot(planners, 0, {1.5, 1.5}, {0.6});
    Draws draws;
    CHECK_FALSE(Area({}, walled, "x").free_place(robot.mover(nobody), draws));
}

TEST_CASE(
    "straight_stop: a motion ends a micrometre before a wall or the map's border, or at its goal") {
    const Scene map(test::drawn_map({"....#", "....#"}));
    Planners planners(map);
    const LoneMover robot(planners, 0, {1, 1}, {0.5});
    const Mover mover = robot.mover(nobody);
    CHECK(straight_stop(mover, {3, 1}) == Vec3{3, 1});
    const Vec3 stop = straight_stop(mover, {9, 1});
    CHECK(stop.x < 3.5);
    CHECK(stop.x > 3.5 - 1.1e-6);
    CHECK(stop.y == 1);
    const Vec3 end = straight_stop(mover, {-8, 1});
    CHECK(end.x >= 0);
    CHECK(end.x < 2e-6);
    const LoneMover wide(planners, 0, {3, 1}, {1.5});
    CHECK(straight_stop(wide.mover(nobody), {1, 1}) == Vec3{3, 1});
}

}  // namespace area_test
