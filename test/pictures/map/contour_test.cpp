// SPDX-License-Identifier: MIT
#include "pictures/map/contour.hpp"

#include "models/link_gain.hpp"
#include "models/propagation/friis.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace contour_test {
using namespace rovernet;

namespace {

constexpr Dbm sensitivity{-75};
constexpr double cell = 0.1;  // [m]

/// A map of 20 m x 20 m around the origin whose levels are a function of the place.
CoverageMap map_of(const std::function<double(Vec3)>& dbm) {
    CoverageMap map{.lower_left = {-10, -10, 1},
                    .cell_width = cell,
                    .cell_height = cell,
                    .columns = 200,
                    .rows = 200};
    for (int row = 0; row < map.rows; ++row) {
        for (int column = 0; column < map.columns; ++column) {
            map.dbm.push_back(dbm(map.centre(column, row)));
        }
    }
    return map;
}

/// A map that is above the level where `inside` says so, and far below elsewhere.
CoverageMap mask(const std::function<bool(Vec3)>& inside) {
    return map_of([&](Vec3 p) { return inside(p) ? -40.0 : -120.0; });
}

double radius_of(Vec3 p) { return std::sqrt(p.x * p.x + p.y * p.y); }

/// What a closed line goes around, > 0 if counter-clockwise [m^2].
double area(const ContourLine& line) {
    double twice = 0;
    for (std::size_t i = 0; i < line.points.size(); ++i) {
        const Vec3 a = line.points[i], b = line.points[(i + 1) % line.points.size()];
        twice += a.x * b.y - b.x * a.y;
    }
    return twice / 2;
}

double length(const std::vector<ContourLine>& lines) {
    double sum = 0;
    for (const auto& line : lines) {
        for (std::size_t i = 1; i < line.points.size(); ++i) {
            sum += distance(line.points[i - 1], line.points[i]);
        }
    }
    return sum;
}

}  // namespace

TEST_CASE(
    "contour: in free space, the contour line is a circle whose radius is the range of the radio") {
    const Scene scene;
    const Radio weak{.power = {-30}};
    const Transmitter t{.model = Friis{}, .radio = weak, .antenna = {1, -2, 1}, .scene = &scene};
    const Db budget = received_power(weak, weak, Db{0}) - sensitivity;
    const double reach = Friis{}.reach(budget, weak.frequency).value;
    REQUIRE((reach > 1 && reach < 6));
    const CoverageMap map = coverage(t, {-10, -10}, {10, 10}, 40'000);
    const auto lines = contours(map, sensitivity, {0.2});
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].closed);
    for (const Vec3 p : lines[0].points) {
        CHECK(std::abs(distance(p, t.antenna) - reach) < 0.2 * cell);
        CHECK(p.z == 1);
    }
    constexpr double of_smoothing = 0.02;  // sigma^2 / radius^2
    CHECK(std::abs(area(lines[0]) / (std::numbers::pi * reach * reach) - 1) < of_smoothing);
}

TEST_CASE("contour: an outer line runs counter-clockwise, the line around a hole runs clockwise") {
    const auto lines = contours(mask([](Vec3 p) { return radius_of(p) < 8 && radius_of(p) > 4; }),
                                sensitivity, {0.15});
    REQUIRE(lines.size() == 2);
    CHECK(area(lines[0]) * area(lines[1]) < 0);
    CHECK(area(lines[0]) + area(lines[1]) > 0);
}

TEST_CASE(
    "contour: details smaller than the smoothing length, such as teeth of a comb, are removed") {
    const auto comb = [](double tooth) {
        return mask([=](Vec3 p) {
            const bool in_tooth = std::fmod(p.y + 20, 3 * tooth) < tooth;
            return p.x < 0 || (p.x < 6 && in_tooth);
        });
    };
    const Meters smoothing{0.3};
    CHECK(length(contours(comb(2), sensitivity, smoothing)) > 45);    // teeth are seen ...
    CHECK(length(contours(comb(0.2), sensitivity, smoothing)) < 25);  // ... or one straight edge
    const auto ray = mask([](Vec3 p) { return p.x < 0 || std::abs(p.y) < 0.1; });
    const auto edge = contours(ray, sensitivity, smoothing);
    REQUIRE(edge.size() == 1);
    for (const Vec3 p : edge[0].points) CHECK(std::abs(p.x) < 2 * smoothing.value);
}

TEST_CASE("contour: smoothing does not move a straight edge") {
    for (const double at : {-3.0, 0.0, 0.05, 7.5}) {
        const auto lines = contours(mask([=](Vec3 p) { return p.x < at; }), sensitivity, {0.3});
        REQUIRE(lines.size() == 1);
        CHECK_FALSE(lines[0].closed);
        for (const Vec3 p : lines[0].points) CHECK(std::abs(p.x - at) <= 0.5 * cell + 1e-9);
    }
}

TEST_CASE("contour: an island too small to be seen is omitted") {
    const auto island = [](double radius) {
        return contours(mask([=](Vec3 p) { return radius_of(p) < radius; }), sensitivity, {0.3});
    };
    CHECK(island(0.5).empty());
    CHECK(island(1).size() == 1);
}

TEST_CASE("contour: a contour line that does not close ends at the edge of the map") {
    const auto lines = contours(mask([](Vec3 p) { return p.y < 0; }), sensitivity, {0.3});
    REQUIRE(lines.size() == 1);
    const auto [first, last] = std::minmax({lines[0].points.front().x, lines[0].points.back().x});
    CHECK(first < -10);
    CHECK(last > 10);
    // What is above the level is on the left of who goes along.
    CHECK(lines[0].points.front().x > lines[0].points.back().x);
}

TEST_CASE("contour: if the whole map is above or below the level, there is no contour line") {
    CHECK(contours(map_of([](Vec3) { return -10.0; }), sensitivity, {0.3}).empty());
    CHECK(contours(map_of([](Vec3) { return -90.0; }), sensitivity, {0.3}).empty());
}

TEST_CASE("contour: on random maps, each line runs from cell to neighbouring cell without jumps") {
    test::Draw draw(5);
    for (int n = 0; n < 20; ++n) {
        CoverageMap map{.columns = 1 + draw.below(40), .rows = 1 + draw.below(40)};
        for (int i = 0; i < map.columns * map.rows; ++i) map.dbm.push_back(draw.uniform(-80, -70));
        for (const ContourLine& line : contours(map, sensitivity, {0.01})) {
            REQUIRE(line.points.size() >= 2);
            for (std::size_t i = 1; i < line.points.size(); ++i) {
                CHECK(distance(line.points[i - 1], line.points[i]) < 1.5);
            }
            if (line.closed) CHECK(distance(line.points.front(), line.points.back()) < 1.5);
        }
    }
}

TEST_CASE("contour: a smoothing length that is not above 0 is refused") {
    CHECK_THROWS_AS(contours(mask([](Vec3) { return true; }), sensitivity, {0}),
                    std::invalid_argument);
}

}  // namespace contour_test
