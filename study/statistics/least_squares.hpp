// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rovernet {

/// Observations of a linear model y = sum over j of x_j b_j + error, with coefficients b_j. Each
/// observation is a row of the x_j and y.
///
/// Rows of one group have dependent errors. A group contains the rows of one replication, or of one
/// receiver of a set of measurements.
struct Observations {
    std::size_t columns = 0;                ///< number of coefficients of the model
    std::vector<double> x = {};             ///< matrix x, row by row, `columns` values for each row
    std::vector<double> y = {};             ///< observed y of each row
    std::vector<std::uint32_t> group = {};  ///< group of each row; empty: a single group

    std::size_t rows() const { return y.size(); }
    std::span<const double> row(std::size_t i) const {
        return std::span(x).subspan(i * columns, columns);
    }
    void add(std::span<const double> row, double value, std::uint32_t of_group = 0) {
        x.insert(x.end(), row.begin(), row.end());
        y.push_back(value);
        group.push_back(of_group);
    }
};

/// Coefficient b_j of a linear model y = sum over j of x_j b_j, in units of y over units of x_j.
struct Coefficient {
    double value = 0;
    double se_plain = 0;  ///< standard error if the errors of all observations are independent
    /// Standard error if the errors of observations in one group depend on each other, and errors
    /// of different groups are independent; NaN if there is only one group.
    double se_by_group = 0;
};

/// Least squares fit of a linear model.
struct LinearFit {
    /// Coefficient b_j of each column x_j; none: the observations do not determine b_j, which is
    /// taken as 0.
    std::vector<std::optional<Coefficient>> coefficients;
    /// Flag of each coefficient; true: the coefficient is fixed at 0, since the fit would make it
    /// negative although it must not be.
    std::vector<bool> at_bound;
    double rmse = 0;   ///< sqrt(SSE / N), in units of y; SSE: sum of squared errors; N: rows
    double sigma = 0;  ///< sqrt(SSE / (N - p)), in units of y; p: number of fitted coefficients

    double predict(std::span<const double> row) const;
};

/// Fits a linear model by Householder QR with column pivoting. A column whose pivot is below 1e-9
/// of the first pivot is omitted. If the fit gives negative values to coefficients that must be >=
/// 0, the most negative of these is fixed at 0, and the others are fitted again, until no such
/// value is negative. Standard errors by group use the sandwich estimator, times G / (G - 1) (N -
/// 1) / (N - p), with G groups, N observations and p fitted coefficients. Source: G. H. Golub, C.
/// F. Van Loan, Matrix Computations, 4th ed., section 5.4; A. C. Cameron, D. L. Miller, A
/// Practitioner's Guide to Cluster-Robust Inference, JHR 50(2), 2015.
/// @param not_below_0  for each coefficient: true if it must be >= 0; empty: any may be negative
/// @throws std::invalid_argument without a row, or if sizes differ or a number is not finite
LinearFit least_squares(const Observations& observations,
                        const std::vector<bool>& not_below_0 = {});

}  // namespace rovernet
