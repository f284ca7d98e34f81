// SPDX-License-Identifier: MIT
#include "study/statistics/comparison.hpp"

#include "sim/random.hpp"
#include "study/statistics/distributions.hpp"
#include "test/study/listed_numbers.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <stdexcept>
#include <vector>

namespace comparison_test {
using namespace rovernet;
using test::is_close;

namespace {

// Relative: a - b is rounded like b, so that small differences have fewer digits.
constexpr double vector_accuracy = 1e-13;
constexpr double end_accuracy = 1e-10;  // of a half-width from the ends, which are far larger
constexpr Bounds share{0.0, 1.0};
constexpr double rounding = 1e-14;  // relative: of some operations
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// The pairs of one study, with a true mean difference, deviation 1 and correlation 0.8.
struct Pairs {
    std::vector<double> a, b;
    Pairs(std::size_t n, std::uint32_t study, double difference) {
        for (std::size_t i = 0; i < n; ++i) {
            const auto draw = [&](std::uint64_t what) {
                return normal(
                    {.replication = study, .purpose = Purpose::destination, .a = what, .index = i});
            };
            const double shared = 2 * draw(0);
            a.push_back(shared + draw(1) + difference);
            b.push_back(shared + draw(2));
        }
    }
};

double half_width_of(const PairedComparison& c) { return (c.high - c.low) / 2; }

/// A comparison of 30 pairs as the sentences need it.
PairedComparison comparison(double mean, double half_width, double p) {
    PairedComparison c;
    c.difference = {.n = 30, .mean = mean, .standard_deviation = 1, .min = -1, .max = 1};
    c.confidence = 0.95;
    c.low = mean - half_width;
    c.high = mean + half_width;
    c.p = p;
    return c;
}

}  // namespace

TEST_CASE(
    "comparison: means, deviations, half-widths and p equal those of R (test vectors paired_t)") {
    const test::Vectors vectors("paired_t.csv");
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        CAPTURE(vectors.text(i, "case"));
        const auto a = test::listed_numbers(vectors.text(i, "a"));
        const auto b = test::listed_numbers(vectors.text(i, "b"));
        const auto c = compare_pairs(a, b);
        REQUIRE(c);
        CHECK(c->difference.n == a.size());
        CHECK(c->confidence == 0.95);
        CHECK(is_close(c->difference.mean, vectors.number(i, "mean"), vector_accuracy));
        CHECK(
            is_close(*c->difference.standard_deviation, vectors.number(i, "sd"), vector_accuracy));
        CHECK(is_close(half_width_of(*c), vectors.number(i, "half_width"), end_accuracy));
        CHECK(is_close(c->p, vectors.number(i, "p"), vector_accuracy));
    }
}

TEST_CASE(
    "comparison: Student's sleep data of ten patients give a difference of 1.58 h with p = 0.2833 "
    "%") {
    const std::array a{0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0};
    const std::array b{1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};
    const auto c = compare_pairs(a, b);
    const double t = c->difference.mean * std::sqrt(10) / *c->difference.standard_deviation;
    CHECK(std::abs(t - -4.0621) < 0.5e-4);  // half the last printed digit
    CHECK(std::abs(c->p - 0.002833) < 0.5e-6);
    CHECK(comparison_text("the first drug", "the second", *c) ==
          "the first drug is 1.58 below the second (95 % interval 0.70 to 2.46, n = 10, p = 0.003, "
          "by Student's t); a difference of 1.23 is found in 80 % of studies with 10 "
          "replications");
}

TEST_CASE("comparison: for fewer than two pairs no comparison is made") {
    CHECK(!compare_pairs({}, {}));
    CHECK(!compare_pairs(std::array{1.0}, std::array{2.0}));
    CHECK(compare_pairs(std::array{1.0, 2.0}, std::array{2.0, 4.0}));
}

TEST_CASE("comparison: exchanging the two samples changes only the sign of the difference") {
    const Pairs pairs(12, 1, 0.5);
    const auto forth = compare_pairs(pairs.a, pairs.b), back = compare_pairs(pairs.b, pairs.a);
    CHECK(forth->difference.mean == -back->difference.mean);
    CHECK(forth->difference.standard_deviation == back->difference.standard_deviation);
    CHECK(forth->low == -back->high);
    CHECK(forth->high == -back->low);
    CHECK(forth->p == back->p);
    CHECK(forth->detectable == back->detectable);
}

TEST_CASE("comparison: the p-value is at most the level exactly when the interval excludes 0") {
    int found = 0;
    for (std::uint32_t study = 0; study < 300; ++study) {
        const Pairs pairs(8, study, 1);
        for (const double confidence : {0.8, 0.95, 0.99}) {
            for (const std::size_t family : {1U, 4U}) {
                const auto c = compare_pairs(pairs.a, pairs.b, {}, confidence, family);
                CHECK(c->found() == (c->low >= 0 || c->high <= 0));
                if (c->found()) ++found;
            }
        }
    }
    CHECK(found > 300);  // both kinds occur
    CHECK(found < 1500);
}

TEST_CASE(
    "comparison: in a family of 5 comparisons, each one is made at a fifth of the significance "
    "level") {
    const Pairs pairs(8, 1, 1);
    const auto together = compare_pairs(pairs.a, pairs.b, {}, 0.95, 5);
    const auto alone = compare_pairs(pairs.a, pairs.b, {}, 0.99);
    CHECK(is_close(together->low, alone->low, end_accuracy));
    CHECK(is_close(together->high, alone->high, end_accuracy));
    CHECK(is_close(together->p, std::min(1.0, 5 * alone->p), rounding));
    CHECK(together->confidence == 0.95);
}

TEST_CASE("comparison: if all differences are equal, the p-value is 0, or 1 if they are all 0") {
    const std::array a{1.0, 2.0, 4.0}, less{0.5, 1.5, 3.5}, constant{3.0, 3.0, 3.0};
    const auto apart = compare_pairs(a, less);
    CHECK(apart->difference.mean == 0.5);
    CHECK(apart->low == apart->high);
    CHECK(apart->p == 0);
    CHECK(apart->detectable == 0.0);
    CHECK(paired_variance_ratio(a, less) == infinity);
    const auto same = compare_pairs(a, a);
    CHECK(same->difference.mean == 0);
    CHECK(same->p == 1);
    CHECK(paired_variance_ratio(a, a) == infinity);
    CHECK(!paired_variance_ratio(constant, constant));
    CHECK(paired_variance_ratio(constant, a) == 1);
    CHECK(!paired_variance_ratio(std::array{1.0}, std::array{2.0}));
}

TEST_CASE(
    "comparison: for equal variances, pairing multiplies the variance of a difference by 1 - "
    "correlation") {
    // var(a - b) = 2 var(a) (1 - r)
    const std::array a{1.0, 2.0, 3.0, 4.0, 5.0}, b{2.0, 1.0, 4.0, 3.0, 5.0};
    CHECK(is_close(*paired_variance_ratio(a, b), 1 / (1 - 0.8), rounding));  // 2.5, covariance 2
    const std::array opposite{-1.0, -2.0, -3.0, -4.0, -5.0};
    CHECK(is_close(*paired_variance_ratio(a, opposite), 0.5, rounding));
}

TEST_CASE(
    "comparison: the detectable difference is the standard error times the test vector "
    "detectable_shift") {
    // The differences are -1, 0, 1: s = 1 (vectors detectable_shift, n = 3).
    const std::array a{1.0, 2.0, 3.0}, b{2.0, 2.0, 2.0};
    const test::Vectors vectors("detectable_shift.csv");
    int compared = 0;
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        if (vectors.number(i, "n") != 3) continue;
        const auto family = static_cast<std::size_t>(vectors.number(i, "family"));
        const auto c = compare_pairs(a, b, {}, vectors.number(i, "confidence"), family);
        CHECK(is_close(*c->detectable, vectors.number(i, "d") / std::sqrt(3), rounding));
        ++compared;
    }
    CHECK(compared == 6);
    CHECK(!compare_pairs(std::array{0.0, 1.0}, std::array{0.0, 0.0}, {}, 0.95, 1000)->detectable);
}

TEST_CASE("comparison: a true difference of the detectable size is found in 80 % of studies") {
    constexpr std::size_t n = 10, family = 4;
    const double size = *t_shift(n - 1, 0.05 / family, 0.8) * std::sqrt(2.0 / n);
    int found = 0;
    for (std::uint32_t study = 0; study < 10'000; ++study) {
        const Pairs pairs(n, study, size);
        std::vector<double> differences(n);
        for (std::size_t i = 0; i < n; ++i) differences[i] = pairs.a[i] - pairs.b[i];
        const Summary s = *summary_of(differences);
        const double t = s.mean * std::sqrt(n) / *s.standard_deviation;
        if (t_exceeded(n - 1, t) <= 0.05 / family) ++found;
    }
    CHECK(std::abs(found - 8000) < 160);  // 4 standard deviations
}

TEST_CASE("comparison: if there is no true difference, the p-value is uniformly distributed") {
    std::array<int, 10> counts{};
    for (std::uint32_t study = 0; study < 2000; ++study) {
        const Pairs pairs(5, study, 0);
        ++counts[static_cast<std::size_t>(compare_pairs(pairs.a, pairs.b)->p * 10)];
    }
    for (const int count : counts) CHECK(std::abs(count - 200) < 4 * std::sqrt(200 * 0.9));
}

TEST_CASE("comparison: input other than pairs of finite numbers is refused") {
    const std::array two{1.0, 2.0}, bad{1.0, not_a_number};
    CHECK_THROWS_WITH_AS(compare_pairs(two, std::array{1.0}),
                         "compare_pairs: expected pairs of values, but one list has 2 and the "
                         "other list has 1 values",
                         std::invalid_argument);
    CHECK_THROWS_WITH(compare_pairs(two, bad), "compare_pairs: values must be finite, got nan");
    CHECK_THROWS_WITH(compare_pairs(bad, two), "compare_pairs: values must be finite, got nan");
    CHECK_THROWS_WITH(compare_pairs(two, two, {}, 1),
                      "compare_pairs: confidence must be above 0 and below 1, got 1");
    CHECK_THROWS_WITH_AS(compare_pairs(two, two, {}, 0.95, 0),
                         "compare_pairs: family (the number of comparisons) must be > 0",
                         std::invalid_argument);
}

TEST_CASE("comparison in words: a sentence states a significant difference") {
    CHECK(comparison_text("friis", "disc", comparison(0.2131, 0.0332, 1e-5)) ==
          "friis is 0.213 above disc (95 % interval 0.180 to 0.246, n = 30, p < 0.001, by "
          "Student's t)");
    CHECK(comparison_text("friis", "disc", comparison(-0.2131, 0.0332, 0.05)) ==
          "friis is 0.213 below disc (95 % interval 0.180 to 0.246, n = 30, p = 0.050, by "
          "Student's t)");
}

TEST_CASE(
    "comparison in words: a sentence states that no difference is found, and what size is "
    "detectable") {
    PairedComparison c = comparison(0.0021, 0.0119, 0.0501);
    CHECK(comparison_text("friis", "disc", c) ==
          "no detectable difference between friis and disc (0.002, 95 % interval -0.010 to 0.014, "
          "n = 30, p = 0.050, by Student's t)");
    c.detectable = 0.0209;
    c.confidence = 0.999;
    c.family = 4;
    c.p = 0.0012;
    CHECK(comparison_text("friis", "disc", c) ==
          "no detectable difference between friis and disc (0.002, 99.9 % interval for all 4 "
          "comparisons: "
          "-0.010 to 0.014, n = 30, p = 0.001, by Student's t); differences below 0.021 cannot be "
          "detected with 30 replications");
}

TEST_CASE("comparison in words: a sentence states that two models are equal in all replications") {
    const std::array a{1.0, 2.0, 4.0}, less{0.9, 1.9, 3.9}, equal{1.0, 2.0, 4.0};
    CHECK(comparison_text("a", "b", *compare_pairs(a, equal)) ==
          "a and b are equal in each of 3 replications");
    const std::array even{0.5, 1.5, 3.5};
    CHECK(comparison_text("a", "b", *compare_pairs(a, even)) ==
          "a is 0.5 above b in each of 3 replications");
    CHECK(comparison_text("a", "b", *compare_pairs(even, a)) ==
          "a is 0.5 below b in each of 3 replications");
    // Equal but for rounding is not equal; what is printed is.
    CHECK(comparison_text("a", "b", *compare_pairs(a, less))
              .starts_with(
                  "a is 0.1 above b (95 % interval 0.1 to 0.1, n = 3, p < 0.001, by Student's t)"));
}

TEST_CASE("comparison in words: the half-width has two digits, without unnecessary decimals") {
    const auto found = [](double mean, double half_width) {
        return comparison_text("a", "b", comparison(mean, half_width, 0));
    };
    CHECK(found(12.34, 1.0).starts_with("a is 12.3 above b (95 % interval 11.3 to 13.3,"));
    CHECK(found(12.34, 0.999).starts_with("a is 12.34 above b (95 % interval 11.34 to 13.34,"));
    CHECK(found(12345.6, 10.4).starts_with("a is 12346 above b (95 % interval 12335 to 12356,"));
    CHECK(found(12345.6, 1234).starts_with("a is 12346 above b (95 % interval 11112 to 13580,"));
    CHECK(found(2e-5, 1.5e-6)
              .starts_with("a is 0.0000200 above b (95 % interval 0.0000185 to 0.0000215,"));
}

TEST_CASE("comparison in words: a number that is rounded to 0 is written without a sign") {
    CHECK(comparison_text("a", "b", comparison(-0.01, 0.5, 0.9))
              .starts_with(
                  "no detectable difference between a and b (-0.01, 95 % interval -0.51 to 0.49,"));
    CHECK(comparison_text("a", "b", comparison(-0.004, 0.5, 0.9))
              .starts_with(
                  "no detectable difference between a and b (0.00, 95 % interval -0.50 to 0.50,"));
}

TEST_CASE("comparison in words: a sentence states whether two models are equivalent") {
    PairedComparison c = comparison(0.01, 0.02, 0.5);
    EquivalenceVerdict verdict;
    verdict.method = IntervalMethod::betting;
    verdict.verdict = Equivalence::within;
    verdict.decided_at = 17;
    CHECK(equivalence_text("disc", "friis", 0.05, verdict, c) ==
          "disc is within 0.05 of friis (95 %, by betting, decided by 17 of 30 replications)");
    verdict.decidable = 0.0341;
    c.family = 4;
    verdict.verdict = Equivalence::outside;
    CHECK(equivalence_text("disc", "friis", 0.05, verdict, c) ==
          "disc is not within 0.05 of friis (95 % for all 4 comparisons, by betting, decided by 17 "
          "of 30 "
          "replications); margins below 0.034 need more than 30 replications");
    CHECK(equivalence_text("disc", "friis", 0.03, verdict, c) ==
          "disc is not within 0.03 of friis (95 % for all 4 comparisons, by betting, decided by 17 "
          "of 30 "
          "replications)");
    verdict.verdict = Equivalence::undecided;
    verdict.decided_at = {};
    verdict.needed = 800;
    CHECK(equivalence_text("disc", "friis", 0.05, verdict, c) ==
          "30 replications do not decide whether disc is within 0.05 of friis (95 % for all 4 "
          "comparisons, by betting); about 800 replications like these would be enough for a "
          "decision");
}

TEST_CASE(
    "comparison: 54 of 60 differences in one direction, and none in the other, are significant "
    "(sign test)") {
    // Paired t: p = 1e-7 or so. The mean of differences from -1 to 1 is not told from 0: a loss of
    // everything in one run of 20 would outweigh it, and 60 runs may miss that.
    std::vector<double> a(60, 0.9), b(60, 0.9);
    for (std::size_t i = 0; i < 54; ++i) b[i] -= i % 9 == 0 ? 0.16 : 0.02;
    const auto c = compare_pairs(a, b, share);
    CHECK(c->above == 54);
    CHECK(c->below == 0);
    CHECK(*c->sign_p < 1e-15);
    CHECK(c->direction_found());
    CHECK(!c->found());
    CHECK(comparison_text("friis", "disc", *c)
              .starts_with("friis is above disc in 54 of 60 replications and below in 0 (p < "
                           "0.001, sign test); no difference of the means is detected ("));
    CHECK(comparison_text("disc", "friis", *compare_pairs(b, a, share))
              .starts_with("disc is below friis in 54 of 60 replications and above in 0"));
    // Twice as large, the mean tells it, and the interval is that of the fixed n.
    for (double& x : b) x = 0.9 - 3 * (0.9 - x);
    const auto larger = compare_pairs(a, b, share);
    CHECK(larger->found());
    CHECK(larger->low > 0);
    CHECK(larger->method == IntervalMethod::star);
    const auto sequence = compare_pairs(a, b, share, 0.95, 1, IntervalMethod::betting);
    CHECK(sequence->high - sequence->low > 1.1 * (larger->high - larger->low));
}

TEST_CASE(
    "comparison: the sign test is binomial and adjusted for the number of comparisons; with "
    "intervals by betting there is no sign test") {
    const std::array a{1.0, 0.0, 1.0, 0.5, 1.0, 1.0, 0.7}, b{0.0, 1.0, 0.0, 0.5, 0.5, 0.5, 0.0};
    // 5 above, 1 below, 1 equal: 2 (1 + 6) / 64.
    CHECK(is_close(*compare_pairs(a, b, share)->sign_p, 14.0 / 64, rounding));
    CHECK(is_close(*compare_pairs(a, b, share, 0.95, 3)->sign_p, 42.0 / 64, rounding));
    CHECK(!compare_pairs(a, b, share, 0.95, 1, IntervalMethod::betting)->sign_p);
    CHECK(compare_pairs(a, a, share)->sign_p == 1.0);
}

TEST_CASE(
    "comparison: by STaR-Bets, the p-value is at most the level exactly if the interval excludes "
    "0") {
    int found = 0, studies = 0;
    for (std::uint32_t study = 0; study < 100; ++study) {
        Pairs pairs(60, study, 1.2);
        for (std::vector<double>* values : {&pairs.a, &pairs.b}) {
            for (double& x : *values) x = std::clamp(0.5 + 0.1 * x, 0.0, 1.0);
        }
        for (const std::size_t family : {1U, 4U}) {
            const auto c = compare_pairs(pairs.a, pairs.b, share, 0.95, family);
            CHECK(c->found() == (c->low > 0 || c->high < 0));
            found += c->found() ? 1 : 0;
            ++studies;
        }
    }
    CHECK(found > 20);
    CHECK(found < studies - 20);
}

TEST_CASE(
    "comparison: by STaR-Bets about 80 % of studies find a difference of the detectable size") {
    constexpr int studies = 300;
    for (const double deviation : {0.05, 0.2, 0.4}) {
        const auto study = [&](std::uint32_t number, double mean) {
            std::vector<double> a, b;
            for (std::size_t i = 0; i < 60; ++i) {
                const Key key{.replication = number, .purpose = Purpose::order, .index = i};
                const double half = std::clamp(mean + deviation * normal(key), -1.0, 1.0) / 2;
                a.push_back(0.5 + half);
                b.push_back(0.5 - half);
            }
            return compare_pairs(a, b, share);
        };
        const double size = *study(10'000, 0)->detectable;
        int found = 0, less = 0;
        for (std::uint32_t number = 0; number < studies; ++number) {
            found += study(number, size)->found() ? 1 : 0;
            less += study(number, size / 2)->found() ? 1 : 0;
        }
        CAPTURE(deviation);
        CHECK(found > 0.7 * studies);
        CHECK(less < 0.6 * studies);
    }
}

}  // namespace comparison_test
