// SPDX-License-Identifier: MIT
#include "study/statistics/equivalence.hpp"

#include "sim/random.hpp"
#include "test/study/listed_numbers.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace equivalence_test {
using namespace rovernet;

namespace {

constexpr Bounds share{0.0, 1.0};
constexpr Bounds delay{0.0, std::nullopt};

/// The tolerance, alpha and number of models of the vectors decide_betting.
constexpr double margin = 0.02, alpha = 0.05;
constexpr std::size_t models = 7;
constexpr double last_digit = 1e-9;  // the vectors' wealths have nine decimals

std::vector<double> series(const test::Vectors& vectors, const std::string& column) {
    std::vector<double> values;
    for (std::size_t i = 0; i < vectors.size(); ++i) values.push_back(vectors.number(i, column));
    return values;
}

std::vector<double> normals(std::size_t n, double mean, double deviation, std::uint32_t study) {
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i) {
        const Key key{.replication = study, .purpose = Purpose::order, .index = i};
        values.push_back(mean + deviation * normal(key));
    }
    return values;
}

std::string word(Equivalence verdict) {
    switch (verdict) {
        case Equivalence::within: return "sufficient";
        case Equivalence::outside: return "insufficient";
        default: return "undecided";
    }
}

EquivalenceVerdict by_betting(std::span<const double> values, double tolerance,
                              std::size_t family = models) {
    return equivalence_of(values, tolerance, share, alpha, family, IntervalMethod::betting);
}

}  // namespace

TEST_CASE("equivalence: the wealths of the betting test equal the test vectors (decide_betting)") {
    const test::Vectors all("decide_series.csv"), expected("decide_betting.csv");
    const char* const names[] = {"not_above", "not_below", "above", "below"};
    for (std::size_t row = 0; row < expected.size(); ++row) {
        const std::string name = expected.text(row, "series");
        CAPTURE(name);
        EquivalenceTest test(margin, alpha, models);
        std::size_t n = 0;
        for (const double d : series(all, name)) {
            test.add(d);
            if (++n != 10 && n != 100 && n != 600) continue;
            for (std::size_t w = 0; w < 4; ++w) {
                const auto column = "lnW" + std::to_string(n) + "_" + names[w];
                CAPTURE(column);
                const double wealth = test.log_wealth(static_cast<EquivalenceTest::Wealth>(w));
                CHECK(test::near(wealth, expected.number(row, column), last_digit));
            }
        }
    }
}

TEST_CASE(
    "equivalence: verdicts, and the replications at which they are given, equal the test vectors "
    "(decide_betting)") {
    const test::Vectors all("decide_series.csv"), expected("decide_betting.csv");
    for (std::size_t row = 0; row < expected.size(); ++row) {
        const std::string name = expected.text(row, "series");
        CAPTURE(name);
        const auto values = series(all, name);
        const auto result = by_betting(values, margin);
        CHECK(word(result.verdict) == expected.text(row, "verdict"));
        CHECK(result.method == IntervalMethod::betting);
        if (result.verdict == Equivalence::undecided) {
            CHECK(!result.decided_at);
            CHECK(result.needed.value_or(601) > 600);
        } else {
            CHECK(*result.decided_at == std::stoul(expected.text(row, "decided_at")));
        }
    }
}

TEST_CASE("equivalence: after three differences, the wealth of the bets equals a value by hand") {
    // Margin 1/2, differences 1/2, 0, 0; the bet against "D >= 1/2": s = -1, m = 1/2.
    // 1: mean 0, var 1/4: lambda = (1/2) / (1/4 + 1/4) = 1, cut at 0.9 / 1.5 = 0.6; W = 1.
    // 2: mean 1/4, var (1/4 + 1/16) / 2 = 5/32: (1/4) / (5/32 + 1/16) = 8/7, cut; W = 1.3.
    // 3: mean 1/6, var (5/16 + 1/36) / 3: (1/3) / (49/432 + 1/9) > 1, cut; W = 1.69.
    EquivalenceTest test(0.5, 0.05, 1);
    for (const double d : {0.5, 0.0, 0.0}) test.add(d);
    CHECK(test::near(std::exp(test.log_wealth(EquivalenceTest::not_above)), 1.69, 1e-14));
    // The bet against "D <= 1/2" never stakes, as the mean stays below.
    CHECK(test.log_wealth(EquivalenceTest::above) == 0);
}

TEST_CASE(
    "equivalence: later differences change neither a verdict nor the replication at which it is "
    "given") {
    const std::vector<double> none(600, 0.0);
    auto then_far = none;
    for (std::size_t i = 300; i < 600; ++i) then_far[i] = 1;
    const auto result = by_betting(then_far, margin);
    CHECK(result.verdict == by_betting(none, margin).verdict);
    CHECK(by_betting(none, margin).decided_at == 288U);
    CHECK(result.decided_at == 288U);
}

TEST_CASE(
    "equivalence: later differences do not change a first verdict, even if they would prove the "
    "opposite") {
    EquivalenceTest test(0.5, 0.05, 1);
    for (int i = 0; i < 30; ++i) test.add(1);
    CHECK(test.verdict() == Equivalence::outside);
    for (int i = 0; i < 3000; ++i) test.add(0);
    const double within = std::min(test.log_wealth(EquivalenceTest::not_above),
                                   test.log_wealth(EquivalenceTest::not_below));
    CHECK(within > std::log(1 / 0.05));
    CHECK(test.verdict() == Equivalence::outside);
}

TEST_CASE("equivalence: an undecided test predicts the number of replications that it needs") {
    const std::vector<double> few(100, 0.0);
    const auto result = by_betting(few, margin);
    CHECK(result.verdict == Equivalence::undecided);
    CHECK(result.needed == 288U);
    CHECK(by_betting({}, margin) ==
          EquivalenceVerdict{
              .method = IntervalMethod::betting, .decided_at = {}, .needed = {}, .decidable = {}});
}

TEST_CASE(
    "equivalence: if no difference can exceed the margin, the verdict needs no replications") {
    const auto result = equivalence_of(std::vector<double>{0.5}, 1, share);
    CHECK(result.verdict == Equivalence::within);
    CHECK(result.decided_at == 0U);
}

TEST_CASE("equivalence: if the difference equals the margin, at most 5 % of verdicts are false") {
    // One replication in 50 loses everything: E D = -0.02, neither within nor outside.
    constexpr int studies = 400;
    std::map<IntervalMethod, int> within, outside;
    for (std::uint32_t study = 0; study < studies; ++study) {
        std::vector<double> values;
        for (std::size_t i = 0; i < 1500; ++i) {
            const Key key{.seed = 1, .replication = study, .purpose = Purpose::order, .index = i};
            values.push_back(uniform(key) < margin ? -1 : 0);
        }
        for (const IntervalMethod method : {IntervalMethod::betting, IntervalMethod::star}) {
            const auto verdict = equivalence_of(values, margin, share, alpha, 1, method).verdict;
            within[method] += verdict == Equivalence::within ? 1 : 0;
            outside[method] += verdict == Equivalence::outside ? 1 : 0;
        }
    }
    // 5 % and three standard deviations of such a share.
    const double most = studies * 0.05 + 3 * std::sqrt(studies * 0.05 * 0.95);
    for (const IntervalMethod method : {IntervalMethod::betting, IntervalMethod::star}) {
        CHECK(within[method] + outside[method] <= most);
    }
}

TEST_CASE(
    "equivalence: a fixed number of values is tested by STaR-Bets, or on request by Student's t") {
    const auto values = normals(150, 0, 0.02, 5);
    const auto fixed = equivalence_of(values, 0.05, share);
    CHECK(fixed.verdict == Equivalence::within);
    CHECK(fixed.method == IntervalMethod::star);
    CHECK(fixed.decided_at == 150U);
    CHECK(*fixed.decidable < 0.05);
    // An interval of +-0.006 around 0.02 by t is within 0.05.
    const auto few = std::span(values).first(20);
    CHECK(equivalence_of(few, 0.05, share).verdict == Equivalence::undecided);
    const auto by_t = equivalence_of(few, 0.05, share, 0.05, 1, IntervalMethod::t);
    CHECK(by_t.verdict == Equivalence::within);
    CHECK(by_t.method == IntervalMethod::t);
    CHECK(*by_t.decidable < 0.02);
    CHECK(equivalence_of(normals(200, 0.3, 0.1, 6), 0.05, share).verdict == Equivalence::outside);
    CHECK(equivalence_of(normals(200, -0.3, 0.1, 6), 0.05, share).verdict == Equivalence::outside);
}

TEST_CASE(
    "equivalence: by STaR-Bets an undecided test predicts the number of replications that it "
    "needs") {
    const std::vector<double> none(60, 0.0);
    const auto open = equivalence_of(none, 0.05, share);
    CHECK(open.verdict == Equivalence::undecided);
    REQUIRE(open.needed);
    CHECK(*open.needed < 250);
    CHECK(equivalence_of(std::vector<double>(*open.needed, 0.0), 0.05, share).verdict ==
          Equivalence::within);
    CHECK(equivalence_of(std::vector<double>(*open.needed - 1, 0.0), 0.05, share).verdict ==
          Equivalence::undecided);
}

TEST_CASE(
    "equivalence: a metric without bounds is tested only once, after all runs, by Student's t") {
    const auto near = equivalence_of(normals(40, 0, 0.1, 1), 0.25, delay);
    CHECK(near.verdict == Equivalence::within);
    CHECK(near.method == IntervalMethod::t);
    CHECK(near.decided_at == 40U);
    CHECK(equivalence_of(normals(40, 1, 0.1, 2), 0.25, delay).verdict == Equivalence::outside);
    const auto open = equivalence_of(normals(10, 0.2, 0.2, 3), 0.25, delay);
    CHECK(open.verdict == Equivalence::undecided);
    CHECK(open.needed.value_or(11) > 10);
}

TEST_CASE("equivalence: by Student's t, the level is divided by the number of compared models") {
    // Mean 0, s = 1, n = 4: one-sided t of 3 degrees at 5 % is 2.3534, at 2.5 % 3.1824.
    const std::vector<double> values = {-1, 1, -0.7071067811865476, 0.7071067811865476};
    CHECK(equivalence_of(values, 1.19, delay, 0.05, 1).verdict == Equivalence::within);
    CHECK(equivalence_of(values, 1.17, delay, 0.05, 1).verdict == Equivalence::undecided);
    CHECK(equivalence_of(values, 1.60, delay, 0.05, 2).verdict == Equivalence::within);
    CHECK(equivalence_of(values, 1.58, delay, 0.05, 2).verdict == Equivalence::undecided);
}

TEST_CASE("equivalence: if all differences are equal, the test by Student's t stays undecided") {
    const auto result = equivalence_of(std::vector<double>(10, 0.0), 0.25, delay);
    CHECK(result.verdict == Equivalence::undecided);
    CHECK(!result.needed);
}

TEST_CASE("equivalence: parameters out of range are refused") {
    const std::vector<double> values = {0.0, 0.1};
    CHECK_THROWS_WITH(equivalence_of(values, 0, share),
                      "equivalence: the margin must be > 0, got 0");
    CHECK_THROWS_WITH(equivalence_of(values, 0.1, share, 0.5),
                      "equivalence: alpha must be above 0 and below 0.5, got 0.5");
    CHECK_THROWS_WITH(equivalence_of(values, 0.1, share, 0.05, 0),
                      "equivalence: family (the number of comparisons) must be > 0");
    CHECK_THROWS(equivalence_of(std::vector<double>{std::nan("")}, 0.1, share));
}

}  // namespace equivalence_test
