// SPDX-License-Identifier: MIT
// Range finders, against the geometry of squares and circles.
#include "scene/range_finder.hpp"

#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace range_finder_test {
using namespace rovernet;
using namespace rovernet::test;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-9;  // [m] cells are that exact

bool near(double a, double b) { return std::abs(a - b) <= rounding; }

std::vector<double> measured(const RangeFinder& finder, const Scene& scene, Vec3 at,
                             double heading = 0, const std::vector<RoundBody>& bodies = {}) {
    std::vector<double> out(static_cast<std::size_t>(finder.beams), -1);
    finder.measure(scene, at, Radians{heading}, bodies, out);
    return out;
}

/// A room of 8 x 8 m inside walls of a metre, with the middle at (5, 5).
OccupancyGrid room() {
    return drawn_map({"##########", "#........#", "#........#", "#........#", "#........#",
                      "#........#", "#........#", "#........#", "#........#", "##########"});
}

constexpr RangeFinder all_around{.beams = 361, .from = Radians{-pi}, .to = Radians{pi}};

}  // namespace

TEST_CASE(
    "range finder: in a square room of 8 m, measured distances to the walls equal the closed "
    "form") {
    const Scene scene(room());
    const auto ways = measured(all_around, scene, {5, 5});
    for (int i = 0; i < all_around.beams; ++i) {
        const double angle = -pi + i * 2 * pi / 360;
        const double way = 4 / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
        CHECK(near(ways[static_cast<std::size_t>(i)], way));
    }
}

TEST_CASE("range finder: beams rotate with the robot and with the map") {
    const RangeFinder three{.beams = 3, .from = Radians{-pi / 2}, .to = Radians{pi / 2}};
    const Scene scene(room());
    const auto ahead = measured(three, scene, {3, 6});
    CHECK(near(ahead[0], 5));  // right: down to y = 1
    CHECK(near(ahead[1], 6));
    CHECK(near(ahead[2], 3));
    const auto turned = measured(three, scene, {3, 6}, pi / 2);
    CHECK(near(turned[0], 6));
    CHECK(near(turned[1], 3));
    CHECK(near(turned[2], 2));
    OccupancyGrid map = room();
    map.yaw = pi / 6;
    map.origin = {100, -50};
    const Vec3 at{100 + 3 * std::cos(pi / 6) - 6 * std::sin(pi / 6),
                  -50 + 3 * std::sin(pi / 6) + 6 * std::cos(pi / 6)};
    const auto on_turned_map = measured(three, Scene(map), at, pi / 6);
    for (std::size_t i = 0; i < 3; ++i) CHECK(near(on_turned_map[i], ahead[i]));
}

TEST_CASE(
    "range finder: another robot is seen as a disc, at exactly the distance of the closed form") {
    const RangeFinder fan{.beams = 101, .from = Radians{-0.5}, .to = Radians{0.5}};
    const double distance = 3, radius = 0.4;
    const auto ways = measured(
        fan, {}, {1, 2}, pi / 3,
        {{{1 + distance * std::cos(pi / 3), 2 + distance * std::sin(pi / 3)}, Meters{radius}},
         {{1 - distance, 2}, Meters{radius}}});
    for (int i = 0; i < fan.beams; ++i) {
        const double a = -0.5 + i * 0.01;
        const double off = distance * std::sin(a);
        const double way = std::abs(off) > radius
                               ? 8
                               : distance * std::cos(a) - std::sqrt(radius * radius - off * off);
        CHECK(near(ways[static_cast<std::size_t>(i)], way));
    }
}

TEST_CASE("range finder: a beam measures the distance to the nearest wall or robot") {
    const RangeFinder one{.beams = 1, .from = Radians{0}, .to = Radians{0}};
    const Scene scene(room());
    CHECK(near(measured(one, scene, {5, 5}, 0, {{{8, 5}, Meters{1}}})[0], 2));
    CHECK(near(measured(one, scene, {5, 5}, 0, {{{20, 5}, Meters{1}}})[0], 4));
    CHECK(near(measured(one, scene, {5, 5}, 0, {{{8, 5}, Meters{1}}, {{7, 5}, Meters{1}}})[0], 1));
}

TEST_CASE(
    "range finder: a beam that hits nothing returns the maximum range, a beam that begins in an "
    "object returns 0") {
    CHECK(measured({}, {}, {0, 0}) == std::vector<double>(181, 8));
    const Scene scene(room());
    CHECK(measured(all_around, scene, {0.5, 0.5}) == std::vector<double>(361, 0));
    CHECK(measured({}, {}, {0, 0}, 0, {{{0.1, 0}, Meters{0.2}}}) == std::vector<double>(181, 0));
    const RangeFinder short_sighted{.beams = 3, .range = Meters{0.5}};
    CHECK(measured(short_sighted, scene, {5, 5}) == std::vector<double>(3, 0.5));
}

TEST_CASE("range finder: a range finder sees over walls that are lower than itself") {
    const Scene scene({room()}, {Material{.height = Meters{1}}});
    const RangeFinder one{.beams = 1, .from = Radians{0}, .to = Radians{0}};
    CHECK(near(measured(one, scene, {5, 5, 0.5})[0], 4));
    CHECK(measured(one, scene, {5, 5, 1.5})[0] == 8);
}

TEST_CASE(
    "range finder: the distance along a beam agrees with a search of the map in steps of 1 cm") {
    Draw draw(7);
    const Scene scene(random_map(draw, 60, 40, 5));
    for (int n = 0; n < 10; ++n) {
        const Vec3 at{draw.uniform(0, 60), draw.uniform(0, 40)};
        const RoundBody body{{at.x + draw.uniform(-5, 5), at.y + draw.uniform(-5, 5)}, Meters{1}};
        const auto ways = measured(all_around, scene, at, 0.1, {body});
        const auto is_hit = [&](Vec3 p) {
            return scene.occupied(p) || distance(p, body.at) <= body.radius.value;
        };
        for (int i = 0; i < all_around.beams; i += 7) {
            const double angle = 0.1 - pi + i * 2 * pi / 360, step = 0.01;
            double way = 0;
            const auto there = [&] { return at + way * Vec3{std::cos(angle), std::sin(angle)}; };
            while (way < 8 && !is_hit(there())) way += step;
            // The walk steps over a corner that it touches for less than a step.
            CHECK(ways[static_cast<std::size_t>(i)] <= way + rounding);
            CHECK(ways[static_cast<std::size_t>(i)] > way - 2 * step);
        }
    }
}

TEST_CASE("range finder: an output array of a wrong size is refused") {
    std::vector<double> out(180);
    CHECK_THROWS_AS(RangeFinder{}.measure({}, {}, Radians{0}, {}, out), std::invalid_argument);
}

}  // namespace range_finder_test
