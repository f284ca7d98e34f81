// SPDX-License-Identifier: MIT
#pragma once

#include "study/statistics/equivalence.hpp"
#include "study/statistics/summary.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Two variants a and b of a scenario, compared over replications that share their random numbers:
/// replication i gives the pair (ai, bi), and only the differences ai - bi count, in the
/// metric's unit.
struct PairedComparison {
    Summary difference;        ///< summary of ai - bi; n >= 2
    double confidence = 0;     ///< probability that all intervals of the family hold [-]
    std::size_t family = 1;    ///< comparisons that are made together, this one among them
    double low = 0, high = 0;  ///< interval for the true mean difference
    IntervalMethod method{};   ///< method by which interval and p were made
    double p = 1;  ///< p-value of "the true mean difference is 0" [-], adjusted for the family
    std::optional<double> detectable;  ///< see compare_pairs()
    std::size_t above = 0, below = 0;  ///< replications in which ai > bi, and ai < bi
    /// p-value of the sign test [-], adjusted for the family; nothing by betting.
    std::optional<double> sign_p;
    friend bool operator==(const PairedComparison&, const PairedComparison&) = default;

    bool found() const { return p <= 1 - confidence; }  ///< the interval leaves 0 out
    /// a and b differ in a single run: one is above the other more often than below.
    bool direction_found() const { return sign_p && *sign_p <= 1 - confidence; }
};

/// Compares the pairs (ai, bi); nothing for fewer than 2.
///
/// low, high: interval_of() the differences at the level 1 - (1 - confidence) / family. All
///   intervals of the family hold together with a probability of at least `confidence`. Where t
///   gives none, as all differences are equal, both are that difference.
/// p: the least 1 - confidence at which the interval leaves 0 out (Bonferroni's adjustment: p of
///   the comparison alone, times the family, at most 1). By t it is that of the two-sided paired
///   t-test: with s the standard deviation of the differences, t = mean sqrt(n) / s has n - 1
///   degrees of freedom. Where s = 0 the limits hold: all differences equal and not 0 is a
///   difference that every replication shows, p = 0; all of them 0 is none, p = 1. By betting and
///   STaR-Bets, p below 1e-6 is not told apart from 1e-6; by betting it holds whenever one looks.
///   By STaR-Bets it is exact at the study's level: below, p is the least of levels that fall by
///   2^1/4 from there, and above of those that fall from 1, up to the first that does not refute.
/// detectable: the smallest true mean difference that a study of this n and s finds by that
/// interval
///   with a probability of 80 %. By t it is d s / sqrt(n), with d of t_shift() at the level
///   (1 - confidence) / family; 0 if s = 0; nothing where t_shift() gives nothing. By betting it
///   is half the interval's width and 0.84 s / sqrt(n); by STaR-Bets, in place of the half width,
///   the mean at which these differences, shifted to it, refute 0.
/// sign_p: where ai and bi are equal the replication counts for neither; of the others each side
///   has the probability 1/2 if neither is more often above (W. J. Conover, Practical Nonparametric
///   Statistics, 3rd ed., section 3.4). It supposes no bounds and n fixed beforehand; what it finds
///   is a direction, not a mean: replications that never occurred may outweigh it in the mean. So
///   the findings of signs hold together at `confidence`, and so do the intervals.
/// Source: A. M. Law, Simulation Modeling and Analysis, 5th ed., sections 9.7 (Bonferroni) and
/// 10.2.1.
///
/// @param  a, b        values of replication i at index i; of the same size
/// @param  bounds      of the metric: bounds_of(); without both of them intervals are by t
/// @param  confidence  [-], above 0 and below 1
/// @param  family      > 0, how many comparisons the study makes together
/// @param  wish        for the method: see method_for()
/// @throws std::invalid_argument if the sizes differ, a value is not finite, confidence or family
///         out of range
std::optional<PairedComparison> compare_pairs(std::span<const double> a, std::span<const double> b,
                                              const Bounds& bounds = {}, double confidence = 0.95,
                                              std::size_t family = 1,
                                              std::optional<IntervalMethod> wish = {});

/// (var a + var b) / var(a - b) [-], by how much pairing divides the replications that a half-width
/// needs; 1 if a and b are uncorrelated, below 1 if pairing harms. Infinite if var(a - b) = 0 and a
/// and b do vary, as pairing leaves no noise then; nothing if none varies, or for fewer than 2
/// pairs.
///
/// Source: A. M. Law, Simulation Modeling and Analysis, 5th ed., section 11.2.
/// @throws std::invalid_argument if the sizes differ or a value is not finite
std::optional<double> paired_variance_ratio(std::span<const double> a, std::span<const double> b);

/// The comparison of a with b in words, found at the level 1 - confidence or not:
///   friis is 0.213 above disc (95 % 0.180 to 0.246, n = 30, p < 0.001, by STaR-Bets); differences
///     below 0.041 cannot be told apart at n = 30
///   friis is above disc in 54 of 60 replications and below in 0 (p < 0.001, sign test); that the
///     mean differs is not shown (0.05, 95 % -0.02 to 0.10, n = 60, p = 0.080, by STaR-Bets); ...
///   no detectable difference between friis and disc (0.002, 95 % for all 4: -0.010 to 0.014,
///     n = 30, p = 0.741, by STaR-Bets); ...
///   friis is 0.2 above disc in each of 30 replications
///   friis and disc are equal in each of 30 replications
/// Half the interval's width is shown with two digits, and everything else to the same decimal.
/// "Told apart" is with 80 % power; without a detectable difference that part is left out.
std::string comparison_text(std::string_view a, std::string_view b,
                            const PairedComparison& comparison);

/// A verdict about the mean difference of a and b in words:
///   disc is within 0.05 of friis (95 % for all 4, by betting, decided by 57 of 100 replications);
///     margins below 0.034 cannot be decided at n = 100
///   disc is not within 0.05 of friis (95 %, by STaR-Bets, decided by 30 of 30 replications); ...
///   not decided by 30 replications whether disc is within 0.05 of friis (95 %, by STaR-Bets);
///     about 800 would decide, if they are as these are
std::string equivalence_text(std::string_view a, std::string_view b, double margin,
                             const EquivalenceVerdict& verdict, const PairedComparison& comparison);

}  // namespace rovernet
