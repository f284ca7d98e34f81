// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

namespace rovernet {

// Probabilities that the statistics of study/ need, from Boost.Math. Unlike sim/math.hpp they go
// through the C library: the last digits may differ from one machine to the next. T is Student's t
// with `degrees` > 0 degrees of freedom; levels and probabilities are above 0 and below 1.

/// The t > 0 that |T| exceeds with probability `level`.
double t_critical(double degrees, double level);

/// The probability that |T| exceeds |t|; 0 for an infinite t.
double t_exceeded(double degrees, double t);

/// The shift at which the two-sided test of this level finds a difference with probability `power`
/// > level: the noncentrality d >= 0 of T with P(|T| > t_critical) = power, wrong sign included.
///
/// Solved by bracketing (TOMS 748) to the last digits; against an integration of 30 digits its
/// relative error is below 1e-14. Nothing if t_critical > 10^4: of one degree of freedom, a level
/// below 6.4e-5. Source: N. L. Johnson, S. Kotz, N. Balakrishnan, Continuous Univariate
/// Distributions, vol. 2, 2nd ed., chapter 31 (the noncentral t distribution).
std::optional<double> t_shift(double degrees, double level, double power);

/// The probability that of n draws, each a success with probability p, at most k are; k < n.
double binomial_at_most(std::size_t k, std::size_t n, double p);

/// Probability that more than k of these draws are successes.
double binomial_above(std::size_t k, std::size_t n, double p);

}  // namespace rovernet
