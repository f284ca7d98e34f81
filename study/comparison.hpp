// SPDX-License-Identifier: MIT
#pragma once

#include "study/equivalence.hpp"
#include "study/summary.hpp"

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
    friend bool operator==(const PairedComparison&, const PairedComparison&) = default;

    bool found() const { return p <= 1 - confidence; }  ///< the interval leaves 0 out
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
///   difference that every replication shows, p = 0; all of them 0 is none, p = 1. By betting, p
///   below 1e-6 is not told apart from 1e-6, and it holds whenever one looks.
/// detectable: by t, the smallest true mean difference that a study of this n and s finds by that
///   interval with a probability of 80 %: d s / sqrt(n), with d of t_shift() at the level
///   (1 - confidence) / family. 0 if s = 0; nothing where t_shift() gives nothing, or by betting.
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
///   friis is 0.213 above disc (95 % 0.180 to 0.246, n = 30, p < 0.001)
///   no detectable difference between friis and disc (0.002, 95 % for all 4: -0.010 to 0.014,
///     n = 30, p = 0.741); at this level a difference of 0.021 would have been detected with 80 %
///     power
///   friis is 0.2 above disc in each of 30 replications
///   friis and disc are equal in each of 30 replications
/// Half the interval's width is shown with two digits, and everything else to the same decimal.
/// Without a detectable difference the first half of its sentence stands alone.
std::string comparison_text(std::string_view a, std::string_view b,
                            const PairedComparison& comparison);

/// A verdict about the mean difference of a and b in words:
///   disc is within 0.05 of friis (95 % for all 4, decided by 57 of 100 replications)
///   disc is not within 0.05 of friis (95 %, decided by 30 of 30 replications)
///   not decided by 30 replications whether disc is within 0.05 of friis (95 %); about 800 would
///     decide, if they are as these are
std::string equivalence_text(std::string_view a, std::string_view b, double margin,
                             const EquivalenceVerdict& verdict, const PairedComparison& comparison);

}  // namespace rovernet
