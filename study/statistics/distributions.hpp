// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

namespace rovernet {

// Distributions used by the statistics of study/, from Boost.Math. Unlike sim/math.hpp, Boost.Math
// calls the C library, so that the last digits may differ between machines. T has Student's t
// distribution with `degrees` > 0 degrees of freedom. Levels and probabilities are above 0 and
// below 1.

/// Critical value t > 0 of Student's t distribution with `degrees` degrees of freedom: a variable T
/// with this distribution has |T| > t with probability `level`.
double t_critical(double degrees, double level);

/// Probability that |T| exceeds |t|, for T with Student's t distribution with `degrees` degrees of
/// freedom; 0 for an infinite t.
double t_exceeded(double degrees, double t);

/// Shift (noncentrality d >= 0) at which the two-sided t-test of this level rejects with
/// probability `power` > level. For a noncentral t variable T with this d, P(|T| > t_critical()) =
/// power, including rejections with the wrong sign.
///
/// Solved by bracketing (TOMS 748) to the last digits; the relative error against an integration
/// with 30 digits is below 1e-14. None if t_critical > 10^4 (with one degree of freedom: a level
/// below 6.4e-5). Source: N. L. Johnson, S. Kotz, N. Balakrishnan, Continuous Univariate
/// Distributions, vol. 2, 2nd ed., chapter 31 (the noncentral t distribution).
std::optional<double> t_shift(double degrees, double level, double power);

/// Probability of at most k successes in n draws with success probability p; k < n.
double binomial_at_most(std::size_t k, std::size_t n, double p);

/// Probability of more than k successes in n draws with success probability p; k < n.
double binomial_above(std::size_t k, std::size_t n, double p);

}  // namespace rovernet
