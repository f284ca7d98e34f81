// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace rovernet {

/// Summary of n replications of one metric, in the metric's unit. The replication is the unit of
/// analysis: one value from each, and the values are independent.
struct Summary {
    std::size_t n = 0;                         ///< values, > 0
    double mean = 0;                           ///< (x1 + ... + xn) / n
    std::optional<double> standard_deviation;  ///< standard deviation with n - 1; nothing for n = 1
    double min = 0;
    double max = 0;
    friend bool operator==(const Summary&, const Summary&) = default;
};

/// The summary of the values, nothing without one. Exact when all are equal: their standard
/// deviation is then 0, and otherwise it is not (for values and differences that are not beyond
/// 1e150 or below 1e-150).
///
/// In two passes over x - x1, in the order of the values: an offset that all share costs no digits,
/// and every machine gets the same bits. Source: T. F. Chan, G. H. Golub, R. J. LeVeque, The
/// American Statistician 37(3), 1983, on shifted data.
/// @throws std::invalid_argument if a value is not finite
std::optional<Summary> summary_of(std::span<const double> values);

/// Half the width of Student's interval for the true mean, mean +- t s / sqrt(n), in the metric's
/// unit; nothing for n = 1. It covers the truth with probability `confidence` if the values are
/// normal, and nearly so for the mean of many that are not.
/// @throws std::invalid_argument unless 0 < confidence < 1
std::optional<double> half_width(const Summary& summary, double confidence = 0.95);

/// Number of replications in all that, as far as these tell, give the wanted half-width: the least
/// N >= n with t(N - 1) s / sqrt(N) <= wanted. Only an estimate, as s is: run more, summarize all,
/// ask again. Nothing for n = 1, or if 10^9 would not do.
///
/// Source: A. M. Law, Simulation Modeling and Analysis, 5th ed., section 9.4.1.
/// @param  wanted  > 0, in the metric's unit
/// @throws std::invalid_argument unless wanted > 0 and 0 < confidence < 1
std::optional<std::size_t> replications_needed(const Summary& summary, double wanted,
                                               double confidence = 0.95);

}  // namespace rovernet
