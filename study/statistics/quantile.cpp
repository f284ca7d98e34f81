// SPDX-License-Identifier: MIT
#include "study/statistics/quantile.hpp"

#include "study/statistics/arguments.hpp"
#include "study/statistics/distributions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace rovernet {
namespace {

/// The rank of the p-quantile of n values, 1 ... n.
std::size_t nearest_rank(double p, std::size_t n) {
    constexpr double rounding = 1e-12;  // 0.07 * 100 is a little more than 7
    const double rank = std::ceil(p * static_cast<double>(n) * (1 - rounding));
    return std::clamp(static_cast<std::size_t>(rank), std::size_t{1}, n);
}

/// Number of 0, 1 ... n - 1 that it holds for, if from some number on it does not.
template <class Holds>
std::size_t leading(std::size_t n, Holds holds) {
    std::size_t low = 0, high = n;
    while (low < high) {
        const std::size_t middle = low + (high - low) / 2;
        if (holds(middle)) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

std::optional<QuantileInterval> interval_of(const std::vector<double>& sorted, double p,
                                            double confidence) {
    const std::size_t n = sorted.size();
    const double tail = (1 - confidence) / 2;
    // Ranks, from 1; there is no value of rank 0 or n + 1.
    const std::size_t low =
        leading(n, [&](std::size_t k) { return binomial_at_most(k, n, p) <= tail; });
    const std::size_t high =
        1 + leading(n, [&](std::size_t k) { return binomial_above(k, n, p) > tail; });
    if (low == 0 || high == n + 1) return std::nullopt;
    return QuantileInterval{
        .low = sorted[low - 1],
        .high = sorted[high - 1],
        .coverage = 1 - binomial_at_most(low - 1, n, p) - binomial_above(high - 1, n, p)};
}

}  // namespace

std::optional<Quantile> quantile_of(std::span<const double> values, double p, double confidence) {
    check_finite(values, "quantile");
    check_open_unit(p, "p", "quantile");
    check_open_unit(confidence, "confidence", "quantile");
    if (values.empty()) return std::nullopt;
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    return Quantile{.value = sorted[nearest_rank(p, sorted.size()) - 1],
                    .interval = interval_of(sorted, p, confidence)};
}

}  // namespace rovernet
