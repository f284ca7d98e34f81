// SPDX-License-Identifier: MIT
#include "study/advise/advise_decision.hpp"

#include "sim/math.hpp"
#include "sim/random.hpp"
#include "test/study/listed_numbers.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace advise_decision_test {
using namespace rovernet;

namespace {

constexpr Bounds share{0.0, 1.0};
constexpr Bounds delay{0.0, std::nullopt};

/// Adds a difference -1 ... 1 as two values of a share.
void add(CandidateDecision& decision, double d) {
    decision.add(std::max(d, 0.0), std::max(-d, 0.0));
}

void add(Ladder& ladder, std::size_t i, double d) {
    ladder.add(i, std::max(d, 0.0), std::max(-d, 0.0));
}

std::string word(Equivalence verdict) {
    switch (verdict) {
        case Equivalence::within: return "sufficient";
        case Equivalence::outside: return "insufficient";
        default: return "go on";
    }
}

/// Differences whose mean is `mean`, from six distributions; u and z are uniform and normal draws.
double draw(int distribution, double mean, std::uint32_t study, std::uint64_t index) {
    const Key key{.seed = 9,
                  .replication = study,
                  .purpose = Purpose::order,
                  .a = static_cast<std::uint64_t>(distribution),
                  .index = index};
    const double u = uniform(key);
    switch (distribution) {
        case 0: return mean + 0.1 * normal_quantile(u);              // normal
        case 1: return u < mean ? 1 : 0;                             // rare, and then all is lost
        case 2: return u < 0.5 + mean ? 0.5 : -0.5;                  // two values
        case 3: return mean + 0.6 * (u - 0.5);                       // uniform
        case 4: return math::exp(math::log(u) * (1 - mean) / mean);  // skewed: beta
        default: return u < 0.9 ? mean - 0.02 : mean + 0.18;         // mixture
    }
}

constexpr int distributions = 6;

}  // namespace

TEST_CASE("decision: verdicts by Student's t equal the test vectors (table decide_looks)") {
    const test::Vectors values("decide_looks_series.csv"), expected("decide_looks.csv");
    for (std::size_t row = 0; row < expected.size(); ++row) {
        const std::string name = expected.text(row, "series");
        const auto n = std::stoul(expected.text(row, "n"));
        CAPTURE(name);
        CAPTURE(n);
        // Tolerance 0.25 s, 7 candidates, 6 looks: at 10 ... 320.
        CandidateDecision decision({.tolerance = 0.25, .bounds = delay, .family = 7, .most = 320});
        for (std::size_t i = 0; i < n; ++i) decision.add(values.number(i, name) + 3, 3);
        CHECK(word(decision.verdict()) == expected.text(row, "verdict"));
        if (decision.verdict() != Equivalence::undecided) CHECK(decision.decided_at() == n);
    }
}

TEST_CASE("decision: by Student's t a verdict is possible only after 10, 20, 40, ... pairs") {
    CandidateDecision decision({.tolerance = 1, .bounds = delay, .family = 1, .most = 100});
    for (int i = 0; i < 15; ++i) {
        decision.add(i % 2 == 0 ? 0.01 : -0.01, 0);
        CHECK(decision.decided_at().has_value() == (i >= 9));
    }
    CHECK(decision.decided_at() == 10U);
}

TEST_CASE("decision: verdicts about the mean equal the test vectors (table decide_betting)") {
    const test::Vectors all("decide_series.csv"), expected("decide_betting.csv");
    for (std::size_t row = 0; row < expected.size(); ++row) {
        const std::string name = expected.text(row, "series");
        CAPTURE(name);
        CandidateDecision decision({.tolerance = 0.02, .bounds = share, .family = 7});
        for (std::size_t i = 0; i < all.size(); ++i) add(decision, all.number(i, name));
        const std::string verdict = expected.text(row, "verdict");
        CHECK(word(decision.verdict()) == (verdict == "undecided" ? "go on" : verdict));
        if (decision.decided_at()) {
            CHECK(*decision.decided_at() == std::stoul(expected.text(row, "decided_at")));
        }
    }
}

TEST_CASE(
    "decision: differences that cancel out are tolerated for the mean, but not for single runs") {
    const DecisionRule rule{.tolerance = 0.1, .bounds = share};
    DecisionRule of_runs = rule;
    of_runs.criterion = ErrorCriterion::run;
    CandidateDecision mean(rule), run(of_runs);
    for (int i = 0; i < 1000; ++i) {
        add(mean, i % 2 == 0 ? 0.3 : -0.3);
        add(run, i % 2 == 0 ? 0.3 : -0.3);
    }
    CHECK(mean.verdict() == Equivalence::within);
    CHECK(run.verdict() == Equivalence::outside);
    CHECK(*run.decided_at() < *mean.decided_at());
}

TEST_CASE(
    "decision: for single runs the verdict `outside` comes from a one-sided test at level alpha") {
    // |D| = 1/2 against a tolerance of 1/4: the wealth "above" grows by the stakes of the formula.
    const DecisionRule rule{
        .criterion = ErrorCriterion::run, .tolerance = 0.25, .bounds = share, .family = 3};
    double wealth = 1, mean = 0, variance = 0.25, sum = 0, squares = 0;
    std::size_t expected = 0;
    for (int n = 0; wealth < 3 / 0.05; ++n) {
        mean = sum / (n + 1);
        variance = (0.25 + squares) / (n + 1);
        const double ahead = mean - 0.25;
        const double stake = std::clamp(ahead / (variance + ahead * ahead), 0.0, 0.9 / 1.25);
        wealth *= 1 + stake * 0.25;
        sum += 0.5;
        const double off = 0.5 - sum / (n + 2);
        squares += off * off;
        ++expected;
    }
    CandidateDecision decision(rule);
    for (int i = 0; i < 200; ++i) add(decision, i % 2 == 0 ? 0.5 : -0.5);
    CHECK(decision.verdict() == Equivalence::outside);
    CHECK(decision.decided_at() == expected);
}

TEST_CASE("decision: later values do not change the first verdict") {
    CandidateDecision decision({.tolerance = 0.1, .bounds = share});
    for (int i = 0; i < 200; ++i) add(decision, 0.01);
    REQUIRE(decision.verdict() == Equivalence::within);
    const auto at = decision.decided_at();
    for (int i = 0; i < 500; ++i) add(decision, 1);
    CHECK(decision.verdict() == Equivalence::within);
    CHECK(decision.decided_at() == at);
    CHECK(decision.n() == 700);
    CHECK(test::is_close(decision.differences().back(), 1, 1e-15));
}

TEST_CASE("decision: a value beyond the metric's bounds is replaced by the nearest bound") {
    CandidateDecision decision({.tolerance = 0.1, .bounds = share});
    for (int i = 0; i < 200; ++i) decision.add(1.6, 1.2);
    CHECK(decision.verdict() == Equivalence::within);
}

TEST_CASE("decision: an undecided comparison predicts the number of replications that it needs") {
    CandidateDecision decision({.tolerance = 0.02, .bounds = share, .family = 7});
    CHECK_FALSE(decision.needed());
    for (int i = 0; i < 100; ++i) add(decision, 0);
    CHECK(decision.needed() == 288U);  // reference: two series that are equal, k = 7
    for (int i = 0; i < 188; ++i) add(decision, 0);
    CHECK(decision.verdict() == Equivalence::within);
    CHECK_FALSE(decision.needed());
}

TEST_CASE(
    "decision: for an undecided candidate, a larger tolerance that would give a verdict is found, "
    "if there is one") {
    const DecisionRule rule{.tolerance = 0.05, .bounds = share, .family = 3};
    CandidateDecision near(rule), few(rule), student({.tolerance = 1, .bounds = delay, .most = 40});
    for (int i = 0; i < 200; ++i) add(near, i % 2 == 0 ? 0.15 : -0.05);
    for (int i = 0; i < 2; ++i) add(few, 0.9);
    for (int i = 0; i < 40; ++i) student.add(i % 2 == 0 ? 3 : 0, 0.6);
    CHECK_FALSE(CandidateDecision(rule).deciding_tolerance());
    CHECK_FALSE(few.deciding_tolerance());
    REQUIRE(near.verdict() == Equivalence::undecided);
    REQUIRE(near.deciding_tolerance());
    CHECK(*near.deciding_tolerance() > 0.05);
    DecisionRule larger = rule;
    larger.tolerance = *near.deciding_tolerance();
    CandidateDecision decided(larger);
    for (int i = 0; i < 200; ++i) add(decided, i % 2 == 0 ? 0.15 : -0.05);
    CHECK(decided.verdict() == Equivalence::within);
    REQUIRE(student.verdict() == Equivalence::undecided);
    CHECK(*student.deciding_tolerance() == doctest::Approx(1.7).epsilon(0.1));
}

TEST_CASE(
    "decision: if candidates differ by exactly the tolerance, at most 5 % of studies give a false "
    "verdict") {
    // Six candidates each, one for each distribution, with E D = 0.05, the tolerance: neither
    // within nor outside. Half of the studies judge the mean, half the single run, where E|D| =
    // 0.05: those distributions that are negative at times are left as they are only for the mean.
    // 600 replications, as each further one costs time.
    constexpr std::uint32_t studies = 1000;
    constexpr std::uint64_t replications = 600;
    constexpr double tolerance = 0.05;
    int false_studies = 0;
    for (std::uint32_t study = 0; study < studies; ++study) {
        const bool of_runs = study % 2 == 1;
        const DecisionRule rule{.criterion = of_runs ? ErrorCriterion::run : ErrorCriterion::mean,
                                .tolerance = tolerance,
                                .bounds = share,
                                .family = distributions};
        bool any = false;
        for (int distribution = 0; distribution < distributions; ++distribution) {
            // E|D| = E D only where D >= 0: the rare loss and the skewed one.
            const int drawn = of_runs ? (distribution % 2 == 0 ? 1 : 4) : distribution;
            const double sign = distribution % 2 == 0 ? 1 : -1;
            CandidateDecision decision(rule);
            for (std::uint64_t i = 0; i < replications; ++i) {
                const auto index = i + static_cast<std::uint64_t>(distribution) * replications;
                add(decision, sign * draw(drawn, tolerance, study, index));
                if (decision.verdict() != Equivalence::undecided) break;
            }
            any = any || decision.verdict() != Equivalence::undecided;
        }
        false_studies += any ? 1 : 0;
    }
    // 5 % and three standard deviations of such a share.
    CHECK(false_studies <= studies * 0.05 + 3 * std::sqrt(studies * 0.05 * 0.95));
}

TEST_CASE(
    "decision: mean differences far below or far above the tolerance get the right verdict, for "
    "six distributions of the differences") {
    for (int distribution = 0; distribution < distributions; ++distribution) {
        CAPTURE(distribution);
        const DecisionRule rule{.tolerance = 0.05, .bounds = share, .family = distributions};
        CandidateDecision near(rule), far(rule);
        for (std::uint64_t i = 0; i < 4000; ++i) {
            add(near, draw(distribution, 0.01, 1, i));
            add(far, draw(distribution, 0.15, 2, i));
        }
        CHECK(near.verdict() == Equivalence::within);
        CHECK(far.verdict() == Equivalence::outside);
    }
}

TEST_CASE("advise: the cheapest candidate within the tolerance is chosen") {
    Ladder ladder(4, {.tolerance = 0.1, .bounds = share, .family = 4});
    const double differences[] = {0.6, 0, 0.01, 0.02};
    for (int r = 0; r < 300; ++r) {
        for (std::size_t i = 0; i < 4; ++i) {
            if (ladder.wants(i)) add(ladder, i, differences[i]);
        }
    }
    CHECK(ladder[0].verdict() == Equivalence::outside);
    CHECK(ladder.choice() == 1U);
    CHECK(ladder.decided());
    // Candidates behind the sufficient one stopped with it, undecided or not.
    CHECK(ladder[2].n() <= ladder[1].n());
    CHECK_FALSE(ladder.wants(3));
}

TEST_CASE(
    "advise: a candidate that is undecided and cheaper than a sufficient one is tested further") {
    Ladder ladder(3, {.tolerance = 0.1, .bounds = share, .family = 3});
    for (int r = 0; r < 300; ++r) {
        add(ladder, 0, r % 2 == 0 ? 0.6 : -0.4);  // the tolerance itself
        add(ladder, 1, 0);
    }
    CHECK(ladder.choice() == 1U);
    CHECK(ladder.wants(0));
    CHECK_FALSE(ladder.wants(1));
    CHECK_FALSE(ladder.wants(2));
    CHECK_FALSE(ladder.decided());
}

TEST_CASE("advise: if there are no candidates, the reference is chosen") {
    const Ladder none(0, {.tolerance = 0.1, .bounds = share});
    CHECK_FALSE(none.choice());
    CHECK(none.decided());
}

TEST_CASE("decision: a tolerance out of range is refused") {
    CHECK_THROWS_WITH(CandidateDecision({.tolerance = 0, .bounds = share}),
                      "decision: the tolerance must be > 0, got 0");
    CHECK_THROWS(CandidateDecision({.tolerance = 1, .bounds = share}));
    CHECK_NOTHROW(CandidateDecision({.tolerance = 10, .bounds = delay}));
}

}  // namespace advise_decision_test
