// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rovernet {

/// Observations of a linear model y = sum over j of x_j b_j + error: one row each.
///
/// The group of a row tells which rows share what is random: those of one replication, or of one
/// receiver of a measured set.
struct Observations {
    std::size_t columns = 0;                ///< coefficients
    std::vector<double> x = {};             ///< row by row; columns values each
    std::vector<double> y = {};             ///< one for each row
    std::vector<std::uint32_t> group = {};  ///< one for each row; empty: all are one group

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

/// A coefficient of a LinearFit, in units of y over units of its column.
struct Coefficient {
    double value = 0;
    double se_plain = 0;     ///< standard error if all errors are independent
    double se_by_group = 0;  ///< standard error if only groups are; not a number with one group
};

/// Least squares fit of a linear model.
struct LinearFit {
    /// By column; nothing for a column that the observations do not determine, which counts as 0.
    std::vector<std::optional<Coefficient>> coefficients;
    std::vector<bool> at_bound;  ///< by column: held at 0, because it may not be negative
    double rmse = 0;             ///< sqrt(SSE / N), in units of y
    double sigma = 0;            ///< sqrt(SSE / (N - p)), in units of y; p fitted coefficients

    double predict(std::span<const double> row) const;
};

/// Fits by Householder QR with column pivoting. A column whose pivot is below 1e-9 of the first is
/// left out. Columns that may not be negative and would be are held at 0 one by one, the most
/// negative first, and the rest is fitted again. Standard errors by group: the sandwich estimator,
/// times G / (G - 1) (N - 1) / (N - p) with G groups.
/// Source: G. H. Golub, C. F. Van Loan, Matrix Computations, 4th ed., section 5.4; A. C. Cameron,
/// D. L. Miller, A Practitioner's Guide to Cluster-Robust Inference, JHR 50(2), 2015.
/// @param not_below_0  by column; empty: all are free
/// @throws std::invalid_argument without a row, or if sizes differ or a number is not finite
LinearFit least_squares(const Observations& observations,
                        const std::vector<bool>& not_below_0 = {});

/// Root mean square error of predicting each group by the fit of the others, in units of y; nothing
/// with fewer than two groups.
std::optional<double> left_out_rmse(const Observations& observations,
                                    const std::vector<bool>& not_below_0 = {});

}  // namespace rovernet
