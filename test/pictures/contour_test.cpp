// SPDX-License-Identifier: MIT
#include "pictures/contour.hpp"

#include "models/disc.hpp"
#include "models/friis.hpp"
#include "models/raytrace_2007.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

using namespace rovernet;

namespace {

constexpr Dbm sensitivity{-75};

double angle_of(Vec3 p) { return std::atan2(p.y, p.x); }
double radius_of(Vec3 p) { return std::sqrt(p.x * p.x + p.y * p.y); }

/// A wall of one cell with its lower left corner there.
Scene block(Vec3 corner, double width, double height) {
    return Scene(OccupancyGrid{.columns = 1,
                               .rows = 1,
                               .cell_width = width,
                               .cell_height = height,
                               .origin = corner,
                               .yaw = 0,
                               .cells = {Cell::occupied}});
}

/// No walls are weaker than these: behind them there is no level left.
Transmitter ray_transmitter(const Scene& scene) {
    return {.model = Raytrace2007{.coefficient = 30, .wall_factor = 100},
            .antenna = {0, 0, 1},
            .scene = &scene};
}

double largest_radius(const std::vector<Vec3>& polygon, double from, double to) {
    double out = -1;
    for (const Vec3 p : polygon) {
        const double angle = angle_of(p);
        if (angle >= from && angle <= to) out = std::max(out, radius_of(p));
    }
    return out;
}

}  // namespace

TEST_CASE("contour: in free space it is the circle of the model's reach") {
    const Scene scene;
    const Transmitter t{.model = Friis{}, .antenna = {3, -4, 1}, .scene = &scene};
    const double reach =
        Friis{}
            .reach(received_power(t.radio, t.radio, Db{0}) - sensitivity, t.radio.frequency)
            .value;
    constexpr double tolerance = 1e-3;  // of the radius
    const auto polygon =
        contour(t, sensitivity, {.farthest = {1e4}, .resolution = {reach * tolerance}});
    REQUIRE(polygon.size() >= 720);
    for (const Vec3 p : polygon) {
        CHECK(std::abs(distance(p, t.antenna) - reach) < tolerance * reach);
        CHECK(p.z == 1);
    }
}

TEST_CASE("contour: it goes round counter-clockwise, once") {
    const Scene scene;
    const Transmitter t{.model = Disc{.range = {10}}, .scene = &scene};
    const auto polygon = contour(t, sensitivity, {.farthest = {100}, .resolution = {0.1}});
    double area = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        area += (a.x * b.y - b.x * a.y) / 2;
    }
    constexpr double tolerance = 1;  // [m^2] resolution / 4 along the rim, and the chords
    CHECK(std::abs(area - 3.14159265 * 100) < 2 * tolerance);
}

TEST_CASE("contour: behind a wall the radius is smaller, beside it it is not") {
    const Scene wall = block({5, -3}, 0.2, 6), open;
    const ContourOptions options{.farthest = {200}, .resolution = {0.05}};
    const auto shadowed = contour(ray_transmitter(wall), sensitivity, options);
    const auto free = contour(ray_transmitter(open), sensitivity, options);
    const double reach = largest_radius(free, -3.2, 3.2);
    CHECK(reach > 20);
    const double half = std::atan2(3, 5.2);
    CHECK(largest_radius(shadowed, -0.9 * half, 0.9 * half) < std::sqrt(5.2 * 5.2 + 9));
    CHECK(largest_radius(shadowed, 1.1 * half, 3.1) == reach);
    CHECK(largest_radius(shadowed, -0.1, 0.1) >= 5);
}

TEST_CASE("contour: a doorpost of 0.1 m at 5 m makes a notch with its true edges") {
    const Scene post = block({5, -0.05}, 0.1, 0.1);
    constexpr double resolution = 0.05;  // [m]
    const auto polygon = contour(ray_transmitter(post), sensitivity,
                                 {.farthest = {200}, .resolution = {resolution}});
    const double reach = largest_radius(polygon, 1, 2);
    std::vector<double> inside;
    for (const Vec3 p : polygon) {
        if (std::abs(angle_of(p)) < 0.1 && radius_of(p) < 0.9 * reach) {
            inside.push_back(angle_of(p));
            CHECK(radius_of(p) > 5 - resolution);
            CHECK(radius_of(p) < 5.2);
        }
    }
    REQUIRE(inside.size() >= 2);
    // The near corners see the post widest; rays are a resolution apart at the far radius.
    const double edge = std::atan2(0.05, 5);
    const double tolerance = 1.5 * resolution / reach;
    CHECK(std::abs(*std::min_element(inside.begin(), inside.end()) + edge) < tolerance);
    CHECK(std::abs(*std::max_element(inside.begin(), inside.end()) - edge) < tolerance);
}

TEST_CASE("contour: where the level is still above at the farthest place, it ends there") {
    const Scene scene;
    const Transmitter t{.model = Friis{}, .scene = &scene};
    const auto polygon = contour(t, sensitivity, {.farthest = {12}, .resolution = {0.1}});
    REQUIRE_FALSE(polygon.empty());
    constexpr double rounding = 1e-12;
    for (const Vec3 p : polygon) CHECK(std::abs(radius_of(p) - 12) < 12 * rounding);
}

TEST_CASE("contour: a level that there is nowhere has none") {
    const Scene scene;
    const Transmitter t{.model = Friis{}, .scene = &scene};
    CHECK(contour(t, {100}, {.farthest = {12}, .resolution = {0.1}}).empty());
}

TEST_CASE("contour: among many walls the number of rays is bounded") {
    test::Draw draw(1);
    const Scene scene(test::random_map(draw, 60, 60, 20));
    Transmitter t = ray_transmitter(scene);
    t.antenna = {30.5, 30.5, 1};
    const auto polygon = contour(t, {-60}, {.farthest = {60}, .resolution = {0.001}});
    CHECK(polygon.size() <= 40'000);
}

TEST_CASE("contour: options that make no sense are the caller's fault") {
    const Scene scene;
    const Transmitter t{.model = Friis{}, .scene = &scene};
    CHECK_THROWS_AS(contour(t, sensitivity, {.farthest = {0}, .resolution = {1}}),
                    std::invalid_argument);
    CHECK_THROWS_AS(contour(t, sensitivity, {.farthest = {10}, .resolution = {-1}}),
                    std::invalid_argument);
}
