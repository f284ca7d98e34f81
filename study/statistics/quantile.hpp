// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

namespace rovernet {

/// Confidence interval for a quantile. Its ends are two of the values, in the metric's unit.
struct QuantileInterval {
    double low = 0;
    double high = 0;
    double coverage = 0;  ///< probability of covering the true quantile [-], >= the confidence
    friend bool operator==(const QuantileInterval&, const QuantileInterval&) = default;
};

/// Quantile of a metric over the replications.
struct Quantile {
    double value = 0;  ///< quantile of the sample, in the metric's unit
    /// Confidence interval for the true quantile; none: too few values.
    std::optional<QuantileInterval> interval;
    friend bool operator==(const Quantile&, const Quantile&) = default;
};

/// Quantile of the values for the probability p by nearest rank (the ceil(p n)-th smallest value),
/// and a distribution-free confidence interval for the true quantile; none without values.
///
/// The interval runs from the l-th to the u-th smallest value, with l the greatest and u the least
/// rank for which P(B < l) <= (1 - confidence) / 2 and P(B >= u) <= (1 - confidence) / 2; B is
/// binomial, of n draws with probability p. It covers the true quantile with probability P(l <= B <
/// u) for a continuous distribution, and at least so for a discrete one. There is no interval if l
/// or u exceeds the available ranks: at 95 % the median needs 6 values, the 0.95-quantile 72.
/// Source: H. A. David, H. N. Nagaraja, Order Statistics, 3rd ed., section 7.1.
///
/// @param  values  in any order
/// @param  p       [-], above 0 and below 1; p n is rounded to a whole number if within 1e-12
/// (relative)
/// @throws std::invalid_argument if a value is not finite, or p or confidence not in (0, 1)
std::optional<Quantile> quantile_of(std::span<const double> values, double p,
                                    double confidence = 0.95);

}  // namespace rovernet
