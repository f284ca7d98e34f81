// SPDX-License-Identifier: MIT
#include "study/statistics/mser5.hpp"

#include "sim/random.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace mser5_test {
using namespace rovernet;

namespace {

std::vector<double> noise(std::size_t n, std::uint32_t series) {
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i) {
        values.push_back(normal({.replication = series, .purpose = Purpose::movement, .index = i}));
    }
    return values;
}

/// White noise of deviation 1 under a bias of `height` that falls to 1/e in `steps` observations.
std::vector<double> fading(std::size_t n, std::uint32_t series, double height, double steps) {
    std::vector<double> values = noise(n, series);
    for (std::size_t i = 0; i < n; ++i) {
        values[i] += height * std::exp(-static_cast<double>(i) / steps);
    }
    return values;
}

/// z(d) of the batch means, each sum anew.
double z(const std::vector<double>& means, std::size_t d) {
    const auto left = static_cast<double>(means.size() - d);
    double sum = 0, squares = 0;
    for (std::size_t i = d; i < means.size(); ++i) sum += means[i];
    for (std::size_t i = d; i < means.size(); ++i) squares += std::pow(means[i] - sum / left, 2);
    return squares / (left * left);
}

Truncation brute_force(const std::vector<double>& series) {
    std::vector<double> means;
    for (std::size_t i = 0; i + 5 <= series.size(); i += 5) {
        double sum = 0;
        for (std::size_t j = i; j < i + 5; ++j) sum += series[j];
        means.push_back(sum / 5);
    }
    std::size_t best = 0;
    for (std::size_t d = 0; d <= means.size() / 2; ++d) {
        if (z(means, d) < z(means, best)) best = d;
    }
    return {.observations = 5 * best, .conclusive = best < means.size() / 2};
}

/// `high` for so many observations, then 0.
std::vector<double> step(std::size_t n, std::size_t transient, double high) {
    std::vector<double> values(n);
    for (std::size_t i = 0; i < transient; ++i) values[i] = high;
    return values;
}

}  // namespace

TEST_CASE(
    "MSER-5: an initial transient of constant height is cut off exactly, to its last observation") {
    for (const std::size_t transient : {0U, 5U, 40U, 95U}) {
        CHECK(mser5(step(200, transient, 3)) ==
              Truncation{.observations = transient, .conclusive = true});
        CHECK(mser5(step(200, transient, -1e9)) ==
              Truncation{.observations = transient, .conclusive = true});
    }
}

TEST_CASE("MSER-5: a batch that the transient touches is deleted entirely") {
    for (const std::size_t transient : {36U, 38U, 40U}) {
        CHECK(mser5(step(200, transient, 3)).observations == 40);
    }
    CHECK(mser5(step(200, 41, 3)).observations == 45);
}

TEST_CASE(
    "MSER-5: if the statistic is smallest at the series' midpoint, the result is not conclusive") {
    CHECK(mser5(step(200, 100, 3)) == Truncation{.observations = 100, .conclusive = false});
    CHECK(mser5(fading(205, 1, 1e3, 1e3)) == Truncation{.observations = 100, .conclusive = false});
}

TEST_CASE("MSER-5: a jump after the middle of the series is not detected") {
    CHECK(mser5(step(200, 150, 3)) == Truncation{.observations = 0, .conclusive = true});
}

TEST_CASE("MSER-5: fewer than 50 observations are all kept, and the result is not conclusive") {
    CHECK(mser5({}) == Truncation{});
    CHECK(mser5(step(49, 20, 3)) == Truncation{.observations = 0, .conclusive = false});
    CHECK(mser5(step(50, 20, 3)) == Truncation{.observations = 20, .conclusive = true});
}

TEST_CASE("MSER-5: an incomplete batch of up to four observations at the end has no effect") {
    for (std::size_t extra = 0; extra < 5; ++extra) {
        std::vector<double> series = fading(200, 2, 10, 15);
        const Truncation whole = mser5(series);
        series.resize(200 + extra, 1e6);
        CHECK(mser5(series) == whole);
    }
}

TEST_CASE("MSER-5: nothing is cut off from a constant series, whatever its level") {
    for (const double level : {0.0, 0.1, 1e9 / 3}) {
        CHECK(mser5(std::vector<double>(1000, level)) ==
              Truncation{.observations = 0, .conclusive = true});
    }
}

TEST_CASE("MSER-5: the result equals an evaluation by brute force on 300 noisy series") {
    int conclusive = 0, deleting = 0;
    for (std::uint32_t series = 0; series < 300; ++series) {
        CAPTURE(series);
        const std::size_t n = 50 + series;
        const double steps = 1 + series % 60;
        const auto values = fading(n, series, series % 3 * 4.0, steps);
        const Truncation found = mser5(values);
        CHECK(found == brute_force(values));
        conclusive += found.conclusive;
        deleting += found.observations > 0;
    }
    CHECK(conclusive > 150);  // all kinds of answers occur
    CHECK(conclusive < 300);
    CHECK(deleting > 150);
    CHECK(deleting < 300);
}

TEST_CASE("MSER-5: adding 1e9 to all observations does not change the result") {
    for (std::uint32_t series = 0; series < 50; ++series) {
        auto values = fading(500, series, 8, 20);
        for (double& v : values) v = std::round(v * 1024) / 1024;  // exact beside 1e9
        const Truncation plain = mser5(values);
        for (double& v : values) v += 1e9;
        CHECK(mser5(values) == plain);
    }
}

TEST_CASE(
    "MSER-5: over 200 series with a transient, means after the cut are nearer to the truth than "
    "means of all") {
    const auto mean_from = [](const std::vector<double>& values, std::size_t first) {
        double sum = 0;
        for (std::size_t i = first; i < values.size(); ++i) sum += values[i];
        return sum / static_cast<double>(values.size() - first);
    };
    double whole = 0, remaining = 0;  // summed squared errors; the truth is 0
    for (std::uint32_t series = 0; series < 200; ++series) {
        const auto values = fading(1000, series, 10, 30);
        whole += std::pow(mean_from(values, 0), 2);
        remaining += std::pow(mean_from(values, mser5(values).observations), 2);
    }
    // Of the whole: (0.3 bias)^2 + 1 / 1000, a bias of 10 * 30 / 1000; of what remains hardly more
    // than the noise.
    CHECK(remaining < whole / 40);
}

TEST_CASE("MSER-5: a value that is not finite is refused") {
    std::vector<double> series(100);
    series[99] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH_AS(mser5(series), "mser5: values must be finite, got nan",
                         std::invalid_argument);
}

}  // namespace mser5_test
