// SPDX-License-Identifier: MIT
#include "study/statistics/bounded_mean.hpp"

#include "sim/random.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace bounded_mean_test {
using namespace rovernet;

namespace {

constexpr Bounds share{0.0, 1.0};
constexpr double bisection = 2e-12;  // of the ends
constexpr double enough = 40;        // 2 / 5 %

std::vector<double> ones(std::size_t n) { return std::vector<double>(n, 1.0); }

std::vector<double> uniforms(std::size_t n) {
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i) {
        values.push_back(uniform({.purpose = Purpose::order, .index = i}));
    }
    return values;
}

bool near(double a, double b, double within) { return std::abs(a - b) <= within; }

}  // namespace

TEST_CASE("bounded mean: the interval from one value equals its closed form") {
    // He stakes half: (1 + x / m) / 2 = 40 at m = x / 79.
    for (const double x : {0.0, 0.25, 0.5, 1.0}) {
        const auto mean = bounded_mean(std::vector{x}, share, 0.95);
        CHECK(near(mean.low, x / 79, bisection));
        CHECK(near(mean.high, 1 - (1 - x) / 79, bisection));
    }
}

TEST_CASE("bounded mean: the wealth of the bets after three values equals a manual computation") {
    // Jeffreys' prior has the moments 1/2, 3/8 and 5/16. With r = x / m - 1 of each value, W =
    // 1 + (r1 + r2 + r3) / 2 + 3/8 (r1 r2 + r1 r3 + r2 r3) + 5/16 r1 r2 r3.
    const std::vector<double> values = {0.5, 0.75, 1.0};
    const double m = bounded_mean(values, share, 0.95).low;
    const double a = 0.5 / m - 1, b = 0.75 / m - 1, c = 1 / m - 1;
    const double wealth =
        1 + (a + b + c) / 2 + 3.0 / 8 * (a * b + a * c + b * c) + 5.0 / 16 * a * b * c;
    CHECK(near(wealth, enough, 1e-8));
}

TEST_CASE("bounded mean: if all values are 1, the interval agrees with a numerical integral") {
    for (const std::size_t n : {2U, 5U, 30U}) {
        const auto mean = bounded_mean(ones(n), share, 0.95);
        CHECK(mean.high == 1);
        // The integral over f = sin^2(a), a uniform, by the rule of midpoints.
        double wealth = 0;
        for (int i = 0; i < 1000; ++i) {
            const double f = std::pow(std::sin((i + 0.5) * std::acos(0.0) / 1000), 2);
            wealth += std::pow(1 - f + f / mean.low, static_cast<double>(n)) / 1000;
        }
        CHECK(near(wealth, enough, 1e-7));
    }
}

TEST_CASE(
    "bounded mean: for equal values the interval is wider than 0, and narrower for more values") {
    double width = 1;
    for (const std::size_t n : {1U, 2U, 5U, 30U, 1000U}) {
        for (const double x : {0.0, 0.3, 1.0}) {
            const auto mean = bounded_mean(std::vector<double>(n, x), share, 0.95);
            CHECK(mean.low <= x);
            CHECK(mean.high >= x);
            CHECK(mean.high - mean.low > 3.6 / static_cast<double>(n + 4));  // ln 40 / n
        }
        const auto mean = bounded_mean(ones(n), share, 0.95);
        CHECK(mean.high - mean.low < width);
        width = mean.high - mean.low;
    }
}

TEST_CASE("bounded mean: after each new value, the interval lies inside the previous interval") {
    const auto values = uniforms(60);
    BoundedMean before{0, 1};
    for (std::size_t n = 1; n <= values.size(); ++n) {
        const auto now = bounded_mean(std::span(values).first(n), share, 0.95);
        CHECK(now.low >= before.low);
        CHECK(now.high <= before.high);
        before = now;
    }
}

TEST_CASE("bounded mean: mirroring or scaling the values mirrors or scales the interval") {
    const auto values = uniforms(40);
    const auto plain = bounded_mean(values, share, 0.95);
    std::vector<double> mirrored, scaled;
    for (const double x : values) {
        mirrored.push_back(1 - x);
        scaled.push_back(2 * x - 1);
    }
    const auto other = bounded_mean(mirrored, share, 0.95);
    CHECK(near(other.low, 1 - plain.high, bisection));
    CHECK(near(other.high, 1 - plain.low, bisection));
    const auto difference = bounded_mean(scaled, {-1.0, 1.0}, 0.95);
    CHECK(near(difference.low, 2 * plain.low - 1, 2 * bisection));
    CHECK(near(difference.high, 2 * plain.high - 1, 2 * bisection));
}

TEST_CASE("bounded mean: more confidence gives a wider interval") {
    const auto values = uniforms(20);
    const auto narrow = bounded_mean(values, share, 0.9), wide = bounded_mean(values, share, 0.99);
    CHECK(wide.low < narrow.low);
    CHECK(wide.high > narrow.high);
}

TEST_CASE("bounded mean: values with a drift give an interval that contains their mean") {
    std::vector<double> values(200, 0.0);
    values.insert(values.end(), 200, 1.0);
    const auto mean = bounded_mean(values, share, 0.95);
    CHECK(mean.low <= 0.5);
    CHECK(mean.high >= 0.5);
    CHECK(mean.low < mean.high);
}

TEST_CASE(
    "bounded mean: the estimated number of replications is the smallest with which similar values "
    "give the wanted half-width") {
    for (const double wanted : {0.1, 0.05, 0.02}) {
        const auto needed = bounded_mean_replications(ones(5), share, wanted, 0.95);
        REQUIRE(needed);
        const auto width = [&](std::size_t n) {
            const auto mean = bounded_mean(ones(n), share, 0.95);
            return mean.high - mean.low;
        };
        CHECK(width(*needed) <= 2 * wanted);
        CHECK(width(*needed - 1) > 2 * wanted);
    }
    const auto values = uniforms(100);
    std::vector<double> again;  // as many copies as are forecast
    const auto needed = bounded_mean_replications(values, share, 0.03, 0.95);
    REQUIRE(needed);
    for (std::size_t i = 0; i < *needed; ++i) again.push_back(values[i % values.size()]);
    const auto mean = bounded_mean(again, share, 0.95);
    CHECK((mean.high - mean.low) / 2 < 0.03);
    CHECK((mean.high - mean.low) / 2 > 0.025);
    CHECK(!bounded_mean_replications(values, share, 1e-7, 0.95));
}

TEST_CASE("bounded mean: invalid arguments are refused") {
    CHECK_THROWS_AS(bounded_mean({}, share, 0.95), std::invalid_argument);
    CHECK_THROWS_AS(bounded_mean(ones(2), {0.0, std::nullopt}, 0.95), std::invalid_argument);
    CHECK_THROWS_AS(bounded_mean(ones(2), share, 1), std::invalid_argument);
    CHECK_THROWS_WITH(bounded_mean(std::vector{0.5, 1.5}, share, 0.95),
                      "bounded_mean: a value is outside the range from 0 to 1");
    CHECK_THROWS_AS(bounded_mean_replications(ones(2), share, 0, 0.95), std::invalid_argument);
}

}  // namespace bounded_mean_test
