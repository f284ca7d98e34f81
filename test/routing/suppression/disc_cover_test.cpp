// SPDX-License-Identifier: MIT
// The share of a disc that other discs leave uncovered, against closed forms and counted points.
#include "routing/suppression/disc_cover.hpp"

#include "sim/random.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace disc_cover_test {
using namespace rovernet;
using std::numbers::pi;

namespace {

/// Closed forms below are met to rounding.
constexpr double rounding = 1e-12;

double uncovered(std::vector<Vec3> centres, double radius = 1) {
    return uncovered_share(centres, radius);
}

/// Share of a disc outside of another one of the same radius, d radii away: 1 - lens / pi.
double outside_lens(double d) {
    return 1 - (2 * std::acos(d / 2) - d / 2 * std::sqrt(4 - d * d)) / pi;
}

double uniform_in(double low, double high, std::uint64_t seed, std::uint64_t index) {
    const Key key{.seed = seed, .purpose = Purpose::placement, .a = 0, .b = 0, .index = index};
    return low + (high - low) * uniform(key);
}

/// Share of the points of a grid in the unit disc that none of the discs covers.
double counted(const std::vector<Vec3>& centres) {
    constexpr int n = 400;
    int in = 0, free = 0;
    for (int i = -n; i <= n; ++i) {
        for (int j = -n; j <= n; ++j) {
            const Vec3 p{(i + 0.3) / n, (j + 0.4) / n, 0};
            if (dot(p, p) > 1) continue;
            ++in;
            bool is_covered = false;
            for (const Vec3& c : centres) is_covered |= squared_distance(p, c) <= 1;
            free += !is_covered;
        }
    }
    return 1.0 * free / in;
}

}  // namespace

TEST_CASE(
    "disc cover: without neighbours, a disc is uncovered; a disc at the same place covers it "
    "fully") {
    CHECK(uncovered({}) == 1);
    CHECK(uncovered({{2, 0, 0}, {0, -3, 0}}) == 1);
    CHECK(uncovered({{0.5, 0, 0}, {0, 0, 0}}) == 0);
}

TEST_CASE("disc cover: a neighbour's disc at any distance covers the lens common to both discs") {
    for (const double d : {0.001, 0.1, 0.5, 1.0, 1.5, 1.999}) {
        for (const double angle : {0.0, 1.0, 2.5, pi, -2.0, -pi / 2}) {
            CAPTURE(d);
            CAPTURE(angle);
            const Vec3 there{d * std::cos(angle), d * std::sin(angle), 0};
            CHECK(std::abs(uncovered({there}) - outside_lens(d)) < rounding);
        }
    }
    CHECK(std::abs(uncovered({{1, 0, 0}}) - (1.0 / 3 + std::sqrt(3) / (2 * pi))) < rounding);
}

TEST_CASE("disc cover: two discs on opposite sides cover two lenses that do not overlap") {
    CHECK(std::abs(uncovered({{1, 0, 0}, {-1, 0, 0}}) - (2 * outside_lens(1) - 1)) < rounding);
}

TEST_CASE(
    "disc cover: three neighbours at distance r (the radius), 120 degrees apart, cover the whole "
    "disc") {
    const Vec3 a{1, 0, 0}, b{-0.5, std::sqrt(0.75), 0}, c{-0.5, -std::sqrt(0.75), 0};
    CHECK(uncovered({a, b, c}) < rounding);
    // Two of them share a lens of centres sqrt(3) apart, which lies in the disc.
    const double lens = 1 - outside_lens(1), shared = 1 - outside_lens(std::sqrt(3));
    CHECK(std::abs(uncovered({a, b}) - (1 - 2 * lens + shared)) < rounding);
}

TEST_CASE(
    "disc cover: the uncovered share does not depend on repeated discs, heights or the unit of "
    "length") {
    const std::vector<Vec3> two{{0.6, 0.2, 0}, {-0.3, 0.9, 0}};
    CHECK(uncovered({two[0], two[1], two[0]}) == uncovered(two));
    CHECK(std::abs(uncovered({{300, 100, 7}, {-150, 450, -9}}, 500) - uncovered(two)) < rounding);
}

TEST_CASE(
    "disc cover: for random discs, the uncovered share agrees with a count of sample points") {
    // A border of length up to 2 pi (k + 1) crosses cells of 1/400: their half area, spread evenly.
    constexpr double grain = 2e-3;
    std::uint64_t index = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        std::vector<Vec3> centres(1 + seed % 7);
        for (Vec3& c : centres) {
            c.x = uniform_in(-1.5, 1.5, seed, index++);
            c.y = uniform_in(-1.5, 1.5, seed, index++);
        }
        CAPTURE(seed);
        CHECK(std::abs(uncovered(centres) - counted(centres)) < grain);
    }
}

TEST_CASE("disc cover: 1 to 4 random neighbours leave .41, .19, .095, .048 of a disc uncovered") {
    // Ni et al., section 2.2 (EAC); 3 sqrt(3) / (4 pi) for one. Four sigma of 4,000 draws.
    constexpr double four_sigma = 0.011;
    const std::vector<double> expected{3 * std::sqrt(3) / (4 * pi), 0.189, 0.095, 0.048};
    std::uint64_t index = 0;
    for (std::size_t k = 1; k <= expected.size(); ++k) {
        double sum = 0;
        constexpr int draws = 4000;
        for (int i = 0; i < draws; ++i) {
            std::vector<Vec3> centres(k);
            for (Vec3& c : centres) {
                const double r = std::sqrt(uniform_in(0, 1, 7, index++));
                const double angle = uniform_in(0, 2 * pi, 7, index++);
                c = {r * std::cos(angle), r * std::sin(angle), 0};
            }
            sum += uncovered(centres);
        }
        CAPTURE(k);
        CHECK(std::abs(sum / draws - expected[k - 1]) < four_sigma);
    }
}

}  // namespace disc_cover_test
