// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace rovernet {

/// Summary of n replications of one metric, in the metric's unit. Each replication gives one value;
/// the values are independent.
struct Summary {
    std::size_t n = 0;  ///< number of values, > 0
    double mean = 0;    ///< (x1 + ... + xn) / n
    /// Sample standard deviation (divisor n - 1); none for n = 1.
    std::optional<double> standard_deviation;
    double min = 0;
    double max = 0;
    friend bool operator==(const Summary&, const Summary&) = default;
};

/// Summary of the values; none if there are no values. The standard deviation is exactly 0 if and
/// only if all values are equal (for values and differences between 1e-150 and 1e150).
///
/// Method: two passes over x - x1, in the order of the values, so that a common offset costs no
/// precision and all machines give the same bits. Source: T. F. Chan, G. H. Golub, R. J. LeVeque,
/// The American Statistician 37(3), 1983, on shifted data.
/// @throws std::invalid_argument if a value is not finite
std::optional<Summary> summary_of(std::span<const double> values);

/// Half-width of Student's interval for the true mean, mean +- t s / sqrt(n), in the metric's unit;
/// none for n = 1. The interval covers the true mean with probability `confidence` if values are
/// normal, and approximately if there are many values.
/// @throws std::invalid_argument unless 0 < confidence < 1
std::optional<double> half_width(const Summary& summary, double confidence = 0.95);

/// Estimated total number of replications for the wanted half-width of Student's interval: the
/// least N >= n with t(N - 1) s / sqrt(N) <= wanted. Since the standard deviation s is an estimate,
/// repeat the estimate after more runs. None for n = 1, or if 10^9 would not suffice.
///
/// Source: A. M. Law, Simulation Modeling and Analysis, 5th ed., section 9.4.1.
/// @param  wanted  > 0, in the metric's unit
/// @throws std::invalid_argument unless wanted > 0 and 0 < confidence < 1
std::optional<std::size_t> replications_needed(const Summary& summary, double wanted,
                                               double confidence = 0.95);

}  // namespace rovernet
