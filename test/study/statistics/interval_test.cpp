// SPDX-License-Identifier: MIT
#include "study/statistics/interval.hpp"

#include "study/statistics/bounded_mean.hpp"
#include "study/statistics/summary.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

namespace interval_test {
using namespace rovernet;

namespace {

constexpr Bounds share{0.0, 1.0};
constexpr Bounds delay{0.0, std::nullopt};

}  // namespace

TEST_CASE(
    "metric bounds: shares, also those of one flow, have the bounds 0 and 1; times have the lower "
    "bound 0") {
    CHECK(bounds_of("delivery_ratio") == share);
    CHECK(bounds_of("delivery_ratio.a") == share);
    CHECK(bounds_of("reach") == share);
    CHECK(bounds_of("latency_mean_s") == delay);
    CHECK(bounds_of("drops.DUP") == delay);
    CHECK(bounds_of("saved_rebroadcasts") == Bounds{std::nullopt, 1.0});
    CHECK(difference_bounds(share) == Bounds{-1.0, 1.0});
    CHECK(difference_bounds(delay) == Bounds{});
}

TEST_CASE(
    "interval: values with two bounds get an interval by STaR-Bets, other values by Student's t") {
    const std::vector<double> values = {0.2, 0.4, 0.5};
    CHECK(interval_of(values, share)->method == IntervalMethod::star);
    CHECK(interval_of(values, share, 0.95, IntervalMethod::betting)->method ==
          IntervalMethod::betting);
    CHECK(interval_of(values, delay)->method == IntervalMethod::t);
    CHECK(interval_of(values, share, 0.95, IntervalMethod::t)->method == IntervalMethod::t);
    CHECK(interval_of(values, delay, 0.95, IntervalMethod::betting)->method == IntervalMethod::t);
    // A reach beyond 1 shows that its bounds do not hold.
    CHECK(interval_of(std::vector{0.9, 1.1}, share)->method == IntervalMethod::t);
}

TEST_CASE("interval: the interval of a ratio that was 1 in every replication extends below 1") {
    const std::vector<double> ones(30, 1.0);
    const auto fixed = interval_of(ones, share);
    CHECK(std::abs(fixed->low - 0.8828) < 5e-5);  // as docs/methods/intervals.md says
    CHECK(fixed->high == 1);
    const auto betting = interval_of(ones, share, 0.95, IntervalMethod::betting);
    CHECK(std::abs(betting->low - 0.8475) < 5e-5);
    CHECK(betting->high == 1);
}

TEST_CASE(
    "interval: a single value of a ratio has a wide interval, a single value of a time has no "
    "interval") {
    CHECK(interval_of(std::vector{1.0}, share)->half_width() > 0.45);
    CHECK(!interval_of(std::vector{1.0}, delay));
    CHECK(!interval_of({}, share));
}

TEST_CASE("interval: for equal values there is no interval by Student's t") {
    CHECK(!interval_of(std::vector<double>(30, 0.25), delay));
    CHECK(!interval_of(std::vector<double>(30, 1.0), share, 0.95, IntervalMethod::t));
}

TEST_CASE("interval: by Student's t, an interval is clipped at the metric's bounds") {
    const std::vector<double> values = {0.0, 0.0, 0.0, 3.0};
    const auto summary = summary_of(values);
    const auto interval = interval_of(values, delay);
    CHECK(interval->low == 0);
    CHECK(interval->high == summary->mean + *half_width(*summary));
    CHECK(interval_of(std::vector{1.0, 1.0, 0.9}, share, 0.95, IntervalMethod::t)->high == 1);
    CHECK(interval_of(values, difference_bounds(delay))->low < 0);
}

TEST_CASE("interval: values that are too skewed for Student's t are marked, other values are not") {
    std::vector<double> rare(30, 0.1);
    rare[7] = 9;
    CHECK(too_skewed_for_t(rare));
    CHECK(interval_of(rare, delay)->skewed);
    CHECK(!too_skewed_for_t(std::vector{1.0, 2.0, 3.0, 4.0, 5.0, 6.0}));
    CHECK(!too_skewed_for_t(std::vector{1.0, 2.0}));
    CHECK(!too_skewed_for_t(std::vector<double>(30, 1.0)));
    // Skewness 1.5 of two values 1 : 4 in shares 1/5 : 4/5; n > 25 G^2 from 57 on.
    std::vector<double> one_in_five;
    for (int i = 0; i < 11; ++i) one_in_five.insert(one_in_five.end(), {4, 1, 1, 1, 1});
    CHECK(one_in_five.size() == 55);
    CHECK(too_skewed_for_t(one_in_five));
    one_in_five.insert(one_in_five.end(), {4, 1, 1, 1, 1});
    CHECK(!too_skewed_for_t(one_in_five));
}

TEST_CASE(
    "interval: the number of replications needed is estimated by the same method as the interval") {
    const std::vector<double> values = {0.5, 0.6, 0.7, 0.6};
    CHECK(replications_for_width(values, delay, 0.05) ==
          replications_needed(*summary_of(values), 0.05));
    CHECK(replications_for_width(values, share, 0.05) ==
          bounded_mean_replications(values, share, 0.05, 0.95));
    CHECK(replications_for_width(values, share, 1) == 4U);
    CHECK(!replications_for_width(std::vector<double>(9, 0.5), delay, 0.05));
}

}  // namespace interval_test
