// SPDX-License-Identifier: MIT
#pragma once

#include "study/statistics/least_squares.hpp"

#include <vector>

namespace rovernet {

/// Linear model of levels of which some were below a floor, and so were not seen.
struct TobitFit {
    std::vector<double> coefficients;  ///< by column, in units of y over units of the column
    double sigma = 0;                  ///< standard deviation of the error, in units of y
    double negative_log_likelihood = 0;
};

/// Fits  y = x b + e,  e normal with deviation sigma, where rows below a floor are known to be
/// below it only: the maximum of
///   sum over the seen of log(phi((y - x b) / sigma) / sigma)
///   + sum over the unseen of log Phi((y - x b) / sigma).
/// Leaving the unseen rows out would make far links look better than they are. Newton's method on
/// b / sigma and 1 / sigma, in which this function is concave.
/// Source: J. Tobin, Estimation of relationships for limited dependent variables, Econometrica
/// 26(1), 1958; R. J. Olsen, Note on the uniqueness of the maximum likelihood estimator for the
/// Tobit model, Econometrica 46(5), 1978.
/// @param unseen  one for each row; true: y is the row's floor, and its level is known to be below
/// @throws std::invalid_argument if sizes differ, a number is not finite, fewer rows are seen than
///         there are coefficients and sigma, or the columns depend on each other
TobitFit tobit(const Observations& observations, const std::vector<bool>& unseen);

}  // namespace rovernet
