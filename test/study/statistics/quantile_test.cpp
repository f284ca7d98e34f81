// SPDX-License-Identifier: MIT
#include "study/statistics/quantile.hpp"

#include "sim/random.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace quantile_test {
using namespace rovernet;

namespace {

constexpr double rounding = 1e-13;  // absolute: of a sum of up to 200 probabilities
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// 1 ... n, so that a value is its rank.
std::vector<double> ranks(std::size_t n) {
    std::vector<double> values(n);
    std::iota(values.begin(), values.end(), 1.0);
    return values;
}

/// Probability that from k = `first` to k = `last` of n draws are successes, added up term by term.
double binomial_sum(std::size_t n, double p, std::size_t first, std::size_t last) {
    double sum = 0;
    for (std::size_t k = first; k <= last && k <= n; ++k) {
        double term = 1;  // n over k p^k (1 - p)^(n - k), its factors mixed to stay near 1
        for (std::size_t i = 1; i <= std::max(k, n - k); ++i) {
            if (i <= k) term *= p * static_cast<double>(n - k + i) / static_cast<double>(i);
            if (i <= n - k) term *= 1 - p;
        }
        sum += term;
    }
    return sum;
}

struct Ranks {
    std::size_t low, high;  ///< 0 and n + 1: none
};

/// The documented ranks, by trying all.
Ranks brute_force(std::size_t n, double p, double confidence) {
    const double tail = (1 - confidence) / 2;
    Ranks found{0, n + 1};
    for (std::size_t rank = 1; rank <= n; ++rank) {
        if (binomial_sum(n, p, 0, rank - 1) <= tail) found.low = rank;
        if (binomial_sum(n, p, n + 1 - rank, n) <= tail) found.high = n + 1 - rank;
    }
    return found;
}

/// The share of 10,000 studies of n normal values whose interval covers the true p-quantile.
double covered(std::size_t n, double p, double confidence) {
    const double truth = normal_quantile(p);
    int count = 0;
    for (std::uint32_t study = 0; study < 10'000; ++study) {
        std::vector<double> values;
        for (std::size_t i = 0; i < n; ++i) {
            values.push_back(normal(
                {.seed = n, .replication = study, .purpose = Purpose::placement, .index = i}));
        }
        const auto interval = quantile_of(values, p, confidence)->interval;
        if (interval->low <= truth && truth <= interval->high) ++count;
    }
    return count / 10'000.0;
}

}  // namespace

TEST_CASE("quantile: without values there is no quantile") { CHECK(!quantile_of({}, 0.5)); }

TEST_CASE(
    "quantile: the p-quantile of n values is the ceil(p n)-th smallest, whatever their order") {
    CHECK(quantile_of(std::array{7.0}, 0.01)->value == 7);
    CHECK(quantile_of(std::array{7.0}, 0.99)->value == 7);
    CHECK(quantile_of(std::array{3.0, 1.0, 2.0}, 0.5)->value == 2);
    CHECK(quantile_of(std::array{4.0, 3.0, 1.0, 2.0}, 0.5)->value == 2);
    CHECK(quantile_of(std::array{4.0, 3.0, 1.0, 2.0}, 0.51)->value == 3);
    for (int percent = 1; percent < 100; ++percent) {
        CHECK(quantile_of(ranks(100), percent / 100.0)->value == percent);
        CHECK(quantile_of(ranks(1000), percent / 100.0)->value == 10 * percent);
    }
}

TEST_CASE(
    "quantile: the median of 10 values lies between the 2nd and the 9th with 97.85 % confidence") {
    // Binomial tables: P(B <= 1) = 11 / 1024, P(B <= 2) = 56 / 1024 is more than 2.5 %.
    const auto interval = quantile_of(ranks(10), 0.5)->interval;
    REQUIRE(interval);
    CHECK(interval->low == 2);
    CHECK(interval->high == 9);
    CHECK(std::abs(interval->coverage - (1 - 22.0 / 1024)) < rounding);
}

TEST_CASE(
    "quantile: at 95 % an interval for the median needs 6 values, one for the 0.95-quantile needs "
    "72") {
    CHECK(!quantile_of(ranks(5), 0.5)->interval);
    CHECK(quantile_of(ranks(6), 0.5)->interval ==
          QuantileInterval{.low = 1, .high = 6, .coverage = 1 - 2.0 / 64});
    CHECK(!quantile_of(ranks(71), 0.95)->interval);
    CHECK(quantile_of(ranks(72), 0.95)->interval->high == 72);
    CHECK(!quantile_of(ranks(71), 0.05)->interval);
    CHECK(quantile_of(ranks(72), 0.05)->interval->low == 1);
}

TEST_CASE(
    "quantile: the ranks and the coverage of an interval equal those found by adding up binomial "
    "probabilities") {
    for (const std::size_t n : {1U, 2U, 6U, 17U, 30U, 101U, 200U}) {
        for (const double p : {0.05, 0.25, 0.5, 0.9, 0.95}) {
            for (const double confidence : {0.5, 0.9, 0.95, 0.99}) {
                CAPTURE(n);
                CAPTURE(p);
                CAPTURE(confidence);
                const auto interval = quantile_of(ranks(n), p, confidence)->interval;
                const Ranks expected = brute_force(n, p, confidence);
                REQUIRE(interval.has_value() == (expected.low > 0 && expected.high <= n));
                if (!interval) continue;
                CHECK(interval->low == static_cast<double>(expected.low));
                CHECK(interval->high == static_cast<double>(expected.high));
                const double coverage = binomial_sum(n, p, expected.low, expected.high - 1);
                CHECK(std::abs(interval->coverage - coverage) < rounding);
                CHECK(interval->coverage >= confidence);
            }
        }
    }
}

TEST_CASE("quantile: in 10,000 studies the intervals cover the true quantile as often as stated") {
    struct Study {
        std::size_t n;
        double p, confidence;
    };
    for (const Study& s : {Study{10, 0.5, 0.95}, Study{30, 0.5, 0.95}, Study{30, 0.25, 0.9},
                           Study{80, 0.95, 0.95}}) {
        CAPTURE(s.n);
        CAPTURE(s.p);
        const double stated = quantile_of(ranks(s.n), s.p, s.confidence)->interval->coverage;
        const double share = covered(s.n, s.p, s.confidence);
        const double four_sigmas = 4 * std::sqrt(stated * (1 - stated) / 10'000);
        CHECK(std::abs(share - stated) < four_sigmas);
        CHECK(share >= s.confidence);
    }
}

TEST_CASE("quantile: invalid arguments are refused") {
    const std::array values{1.0, 2.0};
    for (const double bad : {0.0, 1.0, -0.5, 50.0, not_a_number}) {
        CHECK_THROWS_AS(quantile_of(values, bad), std::invalid_argument);
        CHECK_THROWS_AS(quantile_of(values, 0.5, bad), std::invalid_argument);
    }
    CHECK_THROWS_AS(quantile_of(std::array{1.0, not_a_number}, 0.5), std::invalid_argument);
    CHECK_THROWS_WITH(quantile_of(values, 50), "quantile: p must be above 0 and below 1, got 50");
}

}  // namespace quantile_test
