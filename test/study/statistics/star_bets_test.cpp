// SPDX-License-Identifier: MIT
#include "study/statistics/star_bets.hpp"

#include "sim/random.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace star_bets_test {
using namespace rovernet;

namespace {

constexpr Bounds share{0.0, 1.0};

std::vector<double> normals(std::size_t n, double mean, double deviation, std::uint32_t study) {
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i) {
        const Key key{.replication = study, .purpose = Purpose::order, .index = i};
        values.push_back(std::clamp(mean + deviation * normal(key), 0.0, 1.0));
    }
    return values;
}

/// Variance about m of the tilted past, as the header says it, by bisection alone.
double variance_of(const std::vector<double>& past, double m) {
    std::vector<double> offsets = {-m, 1 - m}, weights = {0.5, 0.5};
    for (const double x : past) {
        offsets.push_back(x - m);
        weights.push_back(1);
    }
    const auto sum = [&](double kappa, int power) {
        double all = 0;
        for (std::size_t i = 0; i < offsets.size(); ++i) {
            all += weights[i] * std::pow(offsets[i], power) / (1 + kappa * offsets[i]);
        }
        return all;
    };
    double low = 0, high = 1 / m;
    for (int i = 0; i < 60 && sum(0, 1) > 0; ++i) {
        const double middle = (low + high) / 2;
        (sum(middle, 1) > 0 ? low : high) = middle;
    }
    return sum(low, 2) / (static_cast<double>(past.size()) + 1);
}

/// Largest wealth of the gambler of the header.
double best_wealth(const std::vector<double>& values, double m, double level) {
    double wealth = 1, best = 1, variance = 1;
    std::size_t next_look = 0;
    for (std::size_t i = 0; i < values.size() && wealth * level < 1; ++i) {
        if (i >= next_look) {
            const auto end = values.begin() + static_cast<std::ptrdiff_t>(i);
            variance = variance_of({values.begin(), end}, m);
            next_look = i + std::max<std::size_t>(1, i / 4);
        }
        const double left = static_cast<double>(values.size() - i);
        const double wanted = wealth > 0 ? std::log(1 / (level * wealth)) : 1e9;
        const double stake =
            left == 1 ? 1 / m : std::min(std::sqrt(2 * wanted / (left * variance)), 1 / m);
        wealth *= std::max(0.0, 1 + stake * (values[i] - m));
        best = std::max(best, wealth);
    }
    return best;
}

}  // namespace

TEST_CASE(
    "STaR-Bets: for one value the interval is that of Markov's inequality, to within one grid "
    "cell") {
    // 1 refutes m if 1 / m reaches 40, so up to m = 1/40; cells of 1/128 begin at 0.0234.
    CHECK(star_refutes(std::vector{1.0}, 0.0249, 0.025));
    CHECK(!star_refutes(std::vector{1.0}, 0.0251, 0.025));
    const auto mean = star_mean(std::vector{1.0}, share, 0.95);
    CHECK(mean.low <= 0.025);
    CHECK(mean.low >= 0.0234);
    CHECK(mean.high == 1);
}

TEST_CASE("STaR-Bets: a mean is rejected exactly if the equations in star_bets.hpp reject it") {
    int refuted = 0, kept = 0;
    for (std::uint32_t study = 0; study < 200; ++study) {
        const auto values = normals(5 + study % 60, 0.6, 0.25, study);
        const double m = 0.3 + 0.0015 * study, level = 0.025;
        const double wealth = best_wealth(values, m, level) * level;
        if (std::abs(wealth - 1) < 0.05) continue;  // V's digits decide
        CAPTURE(study);
        CHECK(star_refutes(values, m, level) == (wealth >= 1));
        ++(wealth >= 1 ? refuted : kept);
    }
    CHECK(refuted > 50);
    CHECK(kept > 50);
}

TEST_CASE(
    "STaR-Bets: every grid cell below the interval is rejected, the first cell inside it is not") {
    const auto values = normals(64, 0.4, 0.2, 1);
    const auto mean = star_mean(values, share, 0.95);
    for (int cell = 1; cell <= 128; ++cell) {
        const double end = cell / 128.0;
        if (end <= mean.low) CHECK(star_refutes(values, end, 0.025));
        if (end >= mean.low && end < mean.low + 1 / 128.0) CHECK(!star_refutes(values, end, 0.025));
    }
}

TEST_CASE("STaR-Bets: mirroring or scaling the values mirrors or scales the interval") {
    const auto values = normals(30, 0.7, 0.2, 2);
    const auto plain = star_mean(values, share, 0.95);
    std::vector<double> mirrored, scaled;
    for (const double x : values) {
        mirrored.push_back(1 - x);
        scaled.push_back(2 * x - 1);
    }
    const auto other = star_mean(mirrored, share, 0.95);
    CHECK(std::abs(other.low - (1 - plain.high)) < 1e-9);
    CHECK(std::abs(other.high - (1 - plain.low)) < 1e-9);
    const auto difference = star_mean(scaled, {-1.0, 1.0}, 0.95);
    CHECK(std::abs(difference.low - (2 * plain.low - 1)) < 1e-9);
    CHECK(std::abs(difference.high - (2 * plain.high - 1)) < 1e-9);
}

TEST_CASE(
    "STaR-Bets: the interval contains the mean, and is wider for more confidence or fewer values") {
    const auto values = normals(120, 0.5, 0.2, 3);
    const auto at = [&](std::size_t n, double confidence) {
        return star_mean(std::span(values).first(n), share, confidence);
    };
    CHECK(at(120, 0.99).low < at(120, 0.95).low);
    CHECK(at(120, 0.99).high > at(120, 0.95).high);
    CHECK(at(120, 0.95).high - at(120, 0.95).low < at(30, 0.95).high - at(30, 0.95).low);
    // Values that drift: no mean is left, but the sample's.
    std::vector<double> drifting(200, 0.0);
    std::fill(drifting.begin() + 100, drifting.end(), 1.0);
    const auto mean = star_mean(drifting, share, 0.95);
    CHECK(mean.low <= 0.5);
    CHECK(mean.high >= 0.5);
}

TEST_CASE("STaR-Bets: invalid arguments are refused") {
    CHECK_THROWS_AS(star_mean({}, share, 0.95), std::invalid_argument);
    CHECK_THROWS_AS(star_mean(std::vector{0.5}, share, 1), std::invalid_argument);
    CHECK_THROWS_AS(star_mean(std::vector{0.5}, {0.0, std::nullopt}, 0.95), std::invalid_argument);
    CHECK_THROWS_WITH(star_mean(std::vector{1.5}, share, 0.95),
                      "star_mean: a value is outside the range from 0 to 1");
}

}  // namespace star_bets_test
