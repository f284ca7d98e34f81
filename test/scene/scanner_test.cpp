// SPDX-License-Identifier: MIT
// Range finders as robots carry them, against rays of our own and against the plain range finder.
#include "scene/scanner.hpp"

#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace scanner_test {
using namespace rovernet;
using namespace rovernet::test;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-9;  // [m] cells are that exact

std::vector<double> measured(const Scanner& scanner, const Scene& scene, const ScannerPose& robot,
                             const std::vector<RoundBody>& bodies = {}) {
    std::vector<double> out(scanner.size(), -1);
    scanner.measure(scene, robot, bodies, out);
    return out;
}

/// A room of 8 x 8 m inside walls of a metre, with the middle at (5, 5).
OccupancyGrid room() {
    return drawn_map({"##########", "#........#", "#........#", "#........#", "#........#",
                      "#........#", "#........#", "#........#", "#........#", "##########"});
}

/// Way from a point in that room to its walls [m].
double way_in_room(double x, double y, double angle) {
    const double cos = std::cos(angle), sin = std::sin(angle);
    const double across = cos > 0 ? (9 - x) / cos : cos < 0 ? (1 - x) / cos : 1e9;
    const double up = sin > 0 ? (9 - y) / sin : sin < 0 ? (1 - y) / sin : 1e9;
    return std::min(across, up);
}

}  // namespace

TEST_CASE("scanner: a scanner at the robot's centre gives exactly the values of its range finder") {
    const Scanner scanner{.finder = {.beams = 77, .range = Meters{20}}};
    const Scene scene(room());
    const std::vector<RoundBody> bodies = {{{7, 6}, Meters{0.3}}};
    std::vector<double> plain(77);
    scanner.finder.measure(scene, {3, 4}, Radians{0.7}, bodies, plain);
    CHECK(measured(scanner, scene, {{3, 4}, Radians{0.7}}, bodies) == plain);
}

TEST_CASE("scanner: beams start at the scanner's position, and rotate with scanner and robot") {
    const Scanner scanner{
        .finder = {.beams = 91, .range = Meters{20}}, .at = {0.5, -0.25}, .heading = Radians{2}};
    for (const double heading : {0.0, 0.4, 3.0, -1.5}) {
        const auto ways = measured(scanner, Scene(room()), {{4, 6}, Radians{heading}});
        const double x = 4 + 0.5 * std::cos(heading) + 0.25 * std::sin(heading);
        const double y = 6 + 0.5 * std::sin(heading) - 0.25 * std::cos(heading);
        for (std::size_t i = 0; i < ways.size(); ++i) {
            const double angle = heading + 2 - pi / 2 + pi * static_cast<double>(i) / 90;
            CHECK(std::abs(ways[i] - way_in_room(x, y, angle)) < rounding);
        }
    }
}

TEST_CASE("scanner: in a ring of sensors each beam has its own origin and direction") {
    const Scanner ring{.finder = {.kind = RangeFinderKind::sonar, .range = Meters{20}},
                       .at = {0.1, 0},
                       .heading = Radians{0.3},
                       .angles = {Radians{pi / 2}, Radians{0.2}, Radians{-2}},
                       .places = {{0, 0.2}, {0.2, 0}, {-0.1, -0.2}}};
    CHECK(ring.size() == 3);
    const double heading = 1.1;
    const auto ways = measured(ring, Scene(room()), {{5, 3}, Radians{heading}});
    for (std::size_t i = 0; i < 3; ++i) {
        const double turned = heading + 0.3;
        const Vec3 place = ring.places[i];
        const double x =
            5 + 0.1 * std::cos(heading) + place.x * std::cos(turned) - place.y * std::sin(turned);
        const double y =
            3 + 0.1 * std::sin(heading) + place.x * std::sin(turned) + place.y * std::cos(turned);
        CHECK(std::abs(ways[i] - way_in_room(x, y, turned + ring.angles[i].value)) < rounding);
    }
    const Scanner from_the_middle{.finder = {.range = Meters{2}},
                                  .angles = {Radians{0}, Radians{pi}}};
    const auto both = measured(from_the_middle, Scene(room()), {{8, 5}, Radians{0}});
    CHECK(std::abs(both[0] - 1) < rounding);
    CHECK(both[1] == 2);
}

TEST_CASE("scanner: each beam of a ring detects robots from the origin of the beam") {
    const Scanner ring{.angles = {Radians{0}}, .places = {{0.5, 0.25}}};
    const std::vector<RoundBody> bodies = {{{4, 2.25}, Meters{0.5}}};
    CHECK(std::abs(measured(ring, {}, {{1, 2}, Radians{0}}, bodies)[0] - 2) < rounding);
}

TEST_CASE(
    "scanner: a scanner without a name has the name of its kind, and an output array of a wrong "
    "size is refused") {
    Scanner scanner{.finder = {.kind = RangeFinderKind::ranger}};
    CHECK(scanner.label() == "ranger");
    scanner.name = "rear";
    CHECK(scanner.label() == "rear");
    scanner.angles = {Radians{0}, Radians{1}};
    std::vector<double> out(1);
    CHECK_THROWS_AS(scanner.measure({}, {}, {}, out), std::invalid_argument);
    scanner.angles.clear();
    CHECK_THROWS_AS(scanner.measure({}, {}, {}, out), std::invalid_argument);
}

}  // namespace scanner_test
