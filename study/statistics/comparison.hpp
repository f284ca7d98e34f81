// SPDX-License-Identifier: MIT
#pragma once

#include "study/statistics/equivalence.hpp"
#include "study/statistics/summary.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace rovernet {

/// Paired comparison of two variants a and b of a scenario over common random numbers. Replication
/// i gives the pair (ai, bi); the statistics use the differences ai - bi, in the metric's unit.
struct PairedComparison {
    Summary difference;  ///< summary of the differences ai - bi; n >= 2
    /// Probability [-] that the intervals of all `family` simultaneous comparisons cover their true
    /// values.
    double confidence = 0;
    std::size_t family = 1;    ///< number of simultaneous comparisons, including this one
    double low = 0, high = 0;  ///< confidence interval for the true mean difference
    IntervalMethod method{};   ///< method of the interval and of the p-value
    double p = 1;  ///< p-value [-] of the hypothesis of equal means, times `family`, at most 1
    std::optional<double> detectable;  ///< smallest detectable difference, see compare_pairs()
    std::size_t above = 0, below = 0;  ///< number of replications with ai > bi, and with ai < bi
    /// p-value of the sign test [-] (see compare_pairs()), adjusted for `family` comparisons; none
    /// with the method betting.
    std::optional<double> sign_p;
    friend bool operator==(const PairedComparison&, const PairedComparison&) = default;

    bool found() const { return p <= 1 - confidence; }  ///< whether the interval excludes 0
    /// Whether the sign test is significant: values of one variant are more often above than below
    /// the values of the other variant in the same replication.
    bool direction_found() const { return sign_p && *sign_p <= 1 - confidence; }
};

/// Compares the pairs (ai, bi); none for fewer than 2 pairs.
///
/// low, high: interval_of() for the differences at confidence 1 - (1 - confidence) / family. With a
///   probability of at least `confidence`, the intervals of all `family` comparisons cover their
///   true values. If all differences are equal, t gives no interval, and both ends are that value.
/// p: the smallest 1 - confidence at which the interval excludes 0 (Bonferroni adjustment: p of the
///   single comparison times the family, at most 1). By t it is the p-value of the two-sided
///   paired t-test: with s the standard deviation of the differences, t = mean sqrt(n) / s has n -
///   1 degrees of freedom. For s = 0 the limits are used: p = 0 if all differences are equal and
///   not 0, p = 1 if all are 0. By betting and STaR-Bets, p below 1e-6 is given as 1e-6. By
///   betting, p is valid at any stopping time. By STaR-Bets, p is found by tests at levels that
///   fall by factors of 2^1/4, from 1 - confidence if the interval excludes 0, or else from 1; p is
///   the last level before the first test that does not reject.
/// detectable: the smallest true mean difference that a study with this n and s detects with a
///   probability (power) of 80 %. By t it is d s / sqrt(n), with d of t_shift() at the level (1 -
///   confidence) / family; 0 if s = 0; none if t_shift() gives none. By betting it is the
///   half-width plus 0.84 s / sqrt(n). By STaR-Bets the half-width is replaced by the mean to
///   which these differences must be shifted to reject 0.
/// sign_p: sign test. Replications with ai = bi are ignored; under the null hypothesis each sign
///   has the probability 1/2 (W. J. Conover, Practical Nonparametric Statistics, 3rd ed., section
///   3.4). The test needs no bounds, but n fixed beforehand. It shows a direction, not a mean
///   difference: rare replications that did not occur may dominate the mean. All sign tests of the
///   family together are valid at `confidence`, as are all intervals together.
/// Source: A. M. Law, Simulation Modeling and Analysis, 5th ed., sections 9.7 (Bonferroni) and
/// 10.2.1.
///
/// @param  a, b        values; index i is replication i; equal sizes
/// @param  bounds      bounds of the metric, see bounds_of(); without two bounds intervals are by t
/// @param  confidence  [-], above 0 and below 1
/// @param  family      number of simultaneous comparisons of the study, > 0
/// @param  wish        preferred method, see method_for()
/// @throws std::invalid_argument if the sizes differ, a value is not finite, confidence or family
///         out of range
std::optional<PairedComparison> compare_pairs(std::span<const double> a, std::span<const double> b,
                                              const Bounds& bounds = {}, double confidence = 0.95,
                                              std::size_t family = 1,
                                              std::optional<IntervalMethod> wish = {});

/// Variance ratio (var a + var b) / var(a - b) [-]: the factor by which pairing reduces the
/// replications needed for a half-width. It is 1 if a and b are uncorrelated, below 1 if pairing
/// harms, and infinite if var(a - b) = 0 although a and b vary. None if neither varies, or for
/// fewer than 2 pairs.
///
/// Source: A. M. Law, Simulation Modeling and Analysis, 5th ed., section 11.2.
/// @throws std::invalid_argument if the sizes differ or a value is not finite
std::optional<double> paired_variance_ratio(std::span<const double> a, std::span<const double> b);

/// Sentence on the comparison of a with b, significant at the level 1 - confidence or not:
///   friis is 0.213 above disc (95 % 0.180 to 0.246, n = 30, p < 0.001, by STaR-Bets); differences
///     below 0.041 cannot be told apart at n = 30
///   friis is above disc in 54 of 60 replications and below in 0 (p < 0.001, sign test); that the
///     mean differs is not shown (0.05, 95 % -0.02 to 0.10, n = 60, p = 0.080, by STaR-Bets); ...
///   no detectable difference between friis and disc (0.002, 95 % for all 4: -0.010 to 0.014,
///     n = 30, p = 0.741, by STaR-Bets); ...
///   friis is 0.2 above disc in each of 30 replications
///   friis and disc are equal in each of 30 replications
/// The half-width has two digits, and all other numbers the same decimals. STaR-Bets is a method of
/// IntervalMethod. "For all 4" appears if `family` is 4: the 4 intervals hold simultaneously. "Told
/// apart" means detected with 80 % power; this part is omitted if `detectable` is empty.
std::string comparison_text(std::string_view a, std::string_view b,
                            const PairedComparison& comparison);

/// Sentence on an equivalence verdict for the mean difference of a and b:
///   disc is within 0.05 of friis (95 % for all 4, by betting, decided by 57 of 100 replications);
///     margins below 0.034 need more than 100 replications
///   disc is not within 0.05 of friis (95 %, by STaR-Bets, decided by 30 of 30 replications); ...
///   not decided by 30 replications whether disc is within 0.05 of friis (95 %, by STaR-Bets);
///     about 800 would decide, if they are as these are
std::string equivalence_text(std::string_view a, std::string_view b, double margin,
                             const EquivalenceVerdict& verdict, const PairedComparison& comparison);

}  // namespace rovernet
