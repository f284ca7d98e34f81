// SPDX-License-Identifier: MIT
#include "study/statistics/summary.hpp"

#include "sim/random.hpp"
#include "test/study/listed_numbers.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace summary_test {
using namespace rovernet;
using test::is_close;

namespace {

constexpr double rounding = 1e-14;   // relative: some operations, each half a digit of 1e-16
constexpr double hundredth = 0.005;  // half the last digit of a book's "0.25"

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// The certified data sets of NIST: `centre`, then pairs half below and half above it.
std::vector<double> nist(double low, double centre, double high, std::size_t n) {
    std::vector<double> values{centre};
    while (values.size() < n) values.insert(values.end(), {low, high});
    return values;
}

/// How many of 10,000 studies of n normal values have an interval that covers the true mean.
int covered(std::size_t n, double confidence) {
    constexpr double truth = 3, deviation = 2;
    int count = 0;
    for (std::uint32_t study = 0; study < 10'000; ++study) {
        std::vector<double> values;
        for (std::size_t i = 0; i < n; ++i) {
            values.push_back(truth + deviation * normal({.seed = n,
                                                         .replication = study,
                                                         .purpose = Purpose::order,
                                                         .index = i}));
        }
        const auto summary = summary_of(values);
        if (std::abs(summary->mean - truth) <= *half_width(*summary, confidence)) ++count;
    }
    return count;
}

/// Of ten values with this mean and variance.
Summary ten(double mean, double variance) {
    return {.n = 10, .mean = mean, .standard_deviation = std::sqrt(variance), .min = {}, .max = {}};
}

}  // namespace

TEST_CASE("summary: without values there is no summary") { CHECK(!summary_of({})); }

TEST_CASE(
    "summary: a single value has a mean, but its deviation, half-width and replications needed are "
    "undefined") {
    const auto summary = summary_of(std::array{-2.5});
    REQUIRE(summary);
    CHECK(*summary ==
          Summary{.n = 1, .mean = -2.5, .standard_deviation = {}, .min = -2.5, .max = -2.5});
    CHECK(!half_width(*summary));
    CHECK(!replications_needed(*summary, 1));
}

TEST_CASE("summary: for equal values deviation and half-width are exactly 0") {
    for (const double value : {0.0, 0.1, -1e9 / 3, 1e150, 1e-150}) {
        for (const std::size_t n : {2U, 3U, 7U, 1000U}) {
            const auto summary = summary_of(std::vector<double>(n, value));
            CHECK(summary->n == n);
            CHECK(summary->mean == value);
            CHECK(summary->standard_deviation == 0.0);
            CHECK(summary->min == value);
            CHECK(summary->max == value);
            CHECK(half_width(*summary) == 0.0);
            CHECK(replications_needed(*summary, 1e-300) == n);
        }
    }
}

TEST_CASE("summary: means, deviations and half-widths equal those of R (test vectors paired_t)") {
    const test::Vectors vectors("paired_t.csv");
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        CAPTURE(vectors.text(i, "case"));
        const auto summary = summary_of(test::listed_numbers(vectors.text(i, "a")));
        REQUIRE(summary);
        CHECK(is_close(summary->mean, vectors.number(i, "mean_a"), rounding));
        CHECK(is_close(*summary->standard_deviation, vectors.number(i, "sd_a"), rounding));
        CHECK(is_close(*half_width(*summary), vectors.number(i, "half_width_a"), rounding));
    }
}

TEST_CASE(
    "summary: standard deviations equal NIST's certified values, even if the mean is 1e8 times as "
    "large") {
    // Statistical Reference Datasets, univariate: NumAcc1, NumAcc3, NumAcc4. The decimals 0.1 and
    // 0.3 themselves are rounded, to 1e-10 beside 1e6 and to 1e-9 beside 1e7.
    struct Certified {
        std::vector<double> values;
        double mean, deviation, input_rounding;
    };
    const std::vector<Certified> sets{
        {nist(10000001, 10000002, 10000003, 3), 10000002, 1, rounding},
        {nist(1000000.1, 1000000.2, 1000000.3, 1001), 1000000.2, 0.1, 2e-9},
        {nist(10000000.1, 10000000.2, 10000000.3, 1001), 10000000.2, 0.1, 2e-8}};
    for (const Certified& set : sets) {
        const auto summary = summary_of(set.values);
        CHECK(is_close(summary->mean, set.mean, rounding));
        CHECK(is_close(*summary->standard_deviation, set.deviation, set.input_rounding));
    }
}

TEST_CASE(
    "summary: adding 1e9 to all values shifts only mean, minimum and maximum, without loss of "
    "digits") {
    std::vector<double> plain, shifted;
    for (std::size_t i = 0; i < 999; ++i) {  // multiples of 2^-10, which stay exact beside 1e9
        const auto steps = below({.purpose = Purpose::order, .index = i}, 4096);
        plain.push_back(static_cast<double>(steps) * 0x1p-10);
        shifted.push_back(plain.back() + 1e9);
    }
    const auto a = summary_of(plain), b = summary_of(shifted);
    CHECK(a->standard_deviation == b->standard_deviation);
    CHECK(a->min + 1e9 == b->min);
    CHECK(a->max + 1e9 == b->max);
    CHECK(is_close(a->mean + 1e9, b->mean, 1e-16));
}

TEST_CASE("summary: the results keep all their digits even if the first value is an outlier") {
    std::vector<double> values{1e9};
    for (int i = 0; i < 4; ++i) {
        values.push_back(1);
        values.push_back(3);
    }
    const auto summary = summary_of(values);
    // In whole numbers: the sum is 1e9 + 16, that of the squares of 9 (x - mean) is below.
    const double mean = (1e9 + 16) / 9;
    const double squares = 8.0 / 9 * (1e9 - 2) * (1e9 - 2) + 8;
    CHECK(is_close(summary->mean, mean, rounding));
    CHECK(is_close(*summary->standard_deviation, std::sqrt(squares / 8), rounding));
    CHECK(summary->min == 1);
    CHECK(summary->max == 1e9);
}

TEST_CASE("summary: a value that is not finite is refused") {
    for (const double bad : {not_a_number, infinity, -infinity}) {
        CHECK_THROWS_AS(summary_of(std::array{1.0, bad}), std::invalid_argument);
    }
    CHECK_THROWS_WITH(summary_of(std::array{infinity}), "summary: values must be finite, got inf");
}

TEST_CASE(
    "half-width: the result equals the bank example in Law's book, 2.03 +- 0.32 min at 90 %") {
    CHECK(is_close(*half_width(ten(2.03, 0.31), 0.90), 0.32, hundredth / 0.32));
}

TEST_CASE("half-width: an invalid confidence is refused") {
    for (const double bad : {0.0, 1.0, 95.0, -0.1, not_a_number}) {
        CHECK_THROWS_AS(half_width(ten(1, 1), bad), std::invalid_argument);
        CHECK_THROWS_AS(replications_needed(ten(1, 1), 1, bad), std::invalid_argument);
    }
    CHECK_THROWS_WITH(half_width(ten(1, 1), 95),
                      "half_width: confidence must be above 0 and below 1, got 95");
}

TEST_CASE("half-width: the 95 % interval covers the truth in 94 to 96 % of 10,000 studies") {
    for (const std::size_t n : {5U, 10U, 30U}) {  // 1 % is 4.6 standard deviations of the share
        CAPTURE(n);
        CHECK(covered(n, 0.95) > 9400);
        CHECK(covered(n, 0.95) < 9600);
    }
    CHECK(std::abs(covered(5, 0.5) - 5000) < 250);  // 5 standard deviations
}

TEST_CASE(
    "replications needed: the result equals the bank example in Law's book, 16 for 0.25 min at 90 "
    "%") {
    CHECK(replications_needed(ten(2.03, 0.31), 0.25, 0.90) == 16);
}

TEST_CASE("replications needed: the result is the smallest sufficient number") {
    for (const double wanted : {3.0, 0.7, 0.5, 0.2, 0.1, 0.07}) {
        const auto enough = [&](std::size_t n) {
            Summary more = ten(0, 1);
            more.n = n;
            return *half_width(more) <= wanted;
        };
        std::size_t n = 10;
        while (!enough(n)) ++n;
        CHECK(replications_needed(ten(0, 1), wanted) == n);
    }
}

TEST_CASE("replications needed: the result is at least the existing number, and at most 10^9") {
    const double reached = *half_width(ten(0, 1));
    CHECK(replications_needed(ten(0, 1), reached) == 10);
    CHECK(replications_needed(ten(0, 1), std::nextafter(reached, 0)) == 11);
    const double z = 1.959963984540054;  // of the normal distribution, which t is by then
    CHECK(replications_needed(ten(0, 1), z / std::sqrt(0.999e9)).has_value());
    CHECK(!replications_needed(ten(0, 1), z / std::sqrt(1.001e9)));
}

TEST_CASE("replications needed: a wanted half-width that is not positive is refused") {
    for (const double bad : {0.0, -1.0, not_a_number}) {
        CHECK_THROWS_AS(replications_needed(ten(0, 1), bad), std::invalid_argument);
    }
    CHECK_THROWS_WITH(replications_needed(ten(0, 1), 0),
                      "replications_needed: the half-width must be > 0, got 0");
}

}  // namespace summary_test
