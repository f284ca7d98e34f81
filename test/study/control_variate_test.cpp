// SPDX-License-Identifier: MIT
#include "study/control_variate.hpp"

#include "sim/random.hpp"
#include "test/study/listed_numbers.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <vector>

namespace control_variate_test {
using namespace rovernet;

namespace {

constexpr double last_digit = 1e-9;  // of the vectors

struct Runs {
    std::vector<double> expensive, cheap;
};

Runs vectors() {
    const test::Vectors rows("control_variate_series.csv");
    Runs runs;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!rows.text(i, "dear").empty()) runs.expensive.push_back(rows.number(i, "dear"));
        runs.cheap.push_back(rows.number(i, "cheap"));
    }
    return runs;
}

}  // namespace

TEST_CASE("control variate: estimate, errors and the best mix are those of the vectors") {
    const test::Vectors rows("control_variate.csv");
    std::map<std::string, double> expected;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        expected[rows.text(i, "quantity")] = rows.number(i, "value");
    }
    const Runs runs = vectors();
    REQUIRE(runs.expensive.size() == 30);
    REQUIRE(runs.cheap.size() == 400);
    const auto found = control_variate(runs.expensive, runs.cheap);
    REQUIRE(found);
    CHECK(test::near(found->beta, expected.at("beta"), last_digit));
    CHECK(test::near(found->rho, expected.at("rho"), last_digit));
    CHECK(test::near(found->estimate, expected.at("estimate"), last_digit));
    CHECK(test::near(found->standard_error, expected.at("standard error"), last_digit));
    CHECK(test::near(found->standard_error_without, expected.at("standard error without"),
                     last_digit));
    const auto mix = best_mix(found->rho, 40);
    REQUIRE(mix);
    CHECK(test::near(mix->ratio, expected.at("best n_l/n_h at a cost ratio of 40"), 1e-7));
    CHECK(test::near(mix->saving, expected.at("saving at that"), last_digit));
}

TEST_CASE("control variate: the estimate is right though the cheap model is wrong by much") {
    // H = x, C = 3 x + 7 with x uniform: the mean of H is 1/2 whatever C adds. rho = 1.
    Runs runs;
    for (std::uint64_t i = 0; i < 4000; ++i) {
        const double x = uniform({.purpose = Purpose::order, .index = i});
        if (i < 20) runs.expensive.push_back(x);
        runs.cheap.push_back(3 * x + 7);
    }
    const auto found = control_variate(runs.expensive, runs.cheap);
    REQUIRE(found);
    CHECK(test::near(found->beta, 1.0 / 3, 1e-12));
    CHECK(test::near(found->rho, 1, 1e-12));
    // The error left is that of 4000 runs: 3 standard errors of 0.2887 / sqrt(4000).
    CHECK(test::near(found->estimate, 0.5, 0.0137));
    CHECK(found->standard_error < found->standard_error_without / 14);
}

TEST_CASE("control variate: a mix of n and m runs is the best at the ratio that best_mix says") {
    // For a cost c = n w + m the variance is (1 - (1 - n/m) rho^2) / n; searched by brute force.
    constexpr double rho = 0.9, w = 10;
    const auto mix = best_mix(rho, w);
    REQUIRE(mix);
    double best = 1e9, at = 0;
    for (double ratio = 1; ratio < 40; ratio += 0.001) {
        const double n = 1 / (w + ratio);
        const double variance = (1 - (1 - 1 / ratio) * rho * rho) / n;
        if (variance < best) {
            best = variance;
            at = ratio;
        }
    }
    CHECK(test::near(mix->ratio, at, 0.002));
    CHECK(test::near(mix->saving, w / best, 1e-6));
}

TEST_CASE("control variate: a cheap model that costs too much or tells nothing saves nothing") {
    CHECK_FALSE(best_mix(0, 1000));
    // 1 < saving: w > (rho / (1 - sqrt(1 - rho^2)))^2 = 13.928; a ratio above 1 needs only w > 3.
    CHECK_FALSE(best_mix(0.5, 3.01));
    CHECK_FALSE(best_mix(0.5, 13.92));
    CHECK(best_mix(0.5, 13.94)->saving > 1);
    CHECK_FALSE(best_mix(0.99999, 0.9));
    CHECK(best_mix(-0.9, 10)->saving == best_mix(0.9, 10)->saving);
    const std::vector<double> same(5, 1.0), other = {1, 2, 3, 4, 5};
    CHECK_FALSE(control_variate(same, other));
    CHECK_FALSE(control_variate(other, same));
    CHECK_FALSE(control_variate(std::vector{1.0}, other));
    CHECK_THROWS(control_variate(other, std::vector{1.0}));
}

}  // namespace control_variate_test
