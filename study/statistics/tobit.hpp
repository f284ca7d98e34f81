// SPDX-License-Identifier: MIT
#pragma once

#include "study/statistics/least_squares.hpp"

#include <vector>

namespace rovernet {

/// Linear model y = x b + e (Tobit model) fitted to levels, some of which were below a floor and
/// not observed (censored).
struct TobitFit {
    /// Coefficients b of the model y = x b + e, in units of y over units of the columns of x.
    std::vector<double> coefficients;
    double sigma = 0;  ///< standard deviation of the model's error, in units of the observed values
    double negative_log_likelihood = 0;
};

/// Fits the model y = x b + e, with normal errors e of standard deviation sigma, by maximum
/// likelihood. Values of unseen rows are only known to be below a floor y. The log-likelihood is
///   sum over the seen rows of log(phi((y - x b) / sigma) / sigma)
///   + sum over the unseen rows of log Phi((y - x b) / sigma),
/// where phi and Phi are density and distribution function of the standard normal distribution.
/// Ignoring unseen rows would underestimate the loss of long links. The maximum is found by
/// Newton's method on b / sigma and 1 / sigma, in which the log-likelihood is concave. Source: J.
/// Tobin, Estimation of relationships for limited dependent variables, Econometrica 26(1), 1958; R.
/// J. Olsen, Note on the uniqueness of the maximum likelihood estimator for the Tobit model,
/// Econometrica 46(5), 1978.
/// @param unseen  for each row; true: y is the floor, and the value was below it
/// @throws std::invalid_argument if sizes differ, a number is not finite, fewer rows are seen than
///         there are coefficients and sigma, or the columns depend on each other
TobitFit tobit(const Observations& observations, const std::vector<bool>& unseen);

}  // namespace rovernet
