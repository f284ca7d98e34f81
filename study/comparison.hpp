// SPDX-License-Identifier: MIT
#pragma once

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
    Summary difference;     ///< of ai - bi; n >= 2
    double confidence = 0;  ///< [-], of the half-width; 1 - confidence is the level of the tests
    double half_width = 0;  ///< of Student's interval for the true mean difference
    double p = 1;           ///< [-], of the two-sided paired t-test, not adjusted
    std::optional<double> detectable;      ///< see compare_pairs()
    std::optional<double> variance_ratio;  ///< see compare_pairs()
    friend bool operator==(const PairedComparison&, const PairedComparison&) = default;
};

/// Compares the pairs (ai, bi); nothing for fewer than 2.
///
/// p: with s the standard deviation of the differences, t = mean sqrt(n) / s has n - 1 degrees of
///   freedom. Where s = 0 the limits hold: all differences equal and not 0 is a difference that
///   every replication shows, p = 0; all of them 0 is none, p = 1.
/// detectable: the smallest true mean difference that a study of this n and s would have found with
///   a probability of 80 %: d s / sqrt(n), with d of t_shift(). Tested at the level
///   (1 - confidence) / family, so that Holm's adjustment would have let it pass whatever the other
///   p-values. 0 if s = 0; nothing where t_shift() gives nothing.
/// variance_ratio: (var a + var b) / var(a - b) [-], by how much pairing divides the replications
///   that a half-width needs; 1 if a and b are uncorrelated, below 1 if pairing harms. Infinite if
///   var(a - b) = 0 and a and b do vary, as pairing leaves no noise then; nothing if none varies.
/// Source: A. M. Law, Simulation Modeling and Analysis, 5th ed., sections 10.2.1 and 11.2.
///
/// @param  a, b        values of replication i at index i; of the same size
/// @param  confidence  [-], above 0 and below 1
/// @param  family      > 0, how many comparisons the study makes together
/// @throws std::invalid_argument if the sizes differ, a value is not finite, confidence or family
///         out of range
std::optional<PairedComparison> compare_pairs(std::span<const double> a, std::span<const double> b,
                                              double confidence = 0.95, std::size_t family = 1);

/// Holm's step-down adjustment of a family of p-values, in the order they came: at most a share
/// `level` of studies has any false finding when those with an adjusted p <= level are taken.
///
/// With p(1) <= ... <= p(m) the i-th is the greatest of min(1, (m - j + 1) p(j)) over j <= i.
/// Source: S. Holm, Scandinavian J. of Statistics 6(2), 1979; in this form S. P. Wright, Biometrics
/// 48(4), 1992.
/// @throws std::invalid_argument unless each p is from 0 to 1
std::vector<double> holm(std::span<const double> p);

/// The comparison of a with b in words, found at the level 1 - confidence or not:
///   friis is 0.213 above disc (95 % 0.180 to 0.246, n = 30, Holm p < 0.001)
///   no detectable difference between friis and disc (0.002, 95 % -0.010 to 0.014, n = 30,
///   Holm p = 0.741); a difference of 0.021 would have been detected with 80 % power
///   friis is 0.2 above disc in each of 30 replications
///   friis and disc are equal in each of 30 replications
/// The interval is that of the one comparison, as if there were no others. Its half-width is shown
/// with two digits, and everything else to the same decimal. Without a detectable difference the
/// first half of its sentence stands alone.
///
/// @param  holm_p  the comparison's p as holm() adjusted it among all that are made
std::string comparison_text(std::string_view a, std::string_view b,
                            const PairedComparison& comparison, double holm_p);

}  // namespace rovernet
