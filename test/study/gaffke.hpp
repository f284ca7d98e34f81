// SPDX-License-Identifier: MIT
#pragma once

#include "sim/random.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace rovernet::test {

/// Lower end of Gaffke's interval for the mean of values in [0, 1]: the quantile `level` of the sum
/// of D_i x_i, with D uniform on the simplex of n + 1 weights and a value 0 added to the x. Tests
/// compare widths of intervals with this interval. Its coverage was sufficient in every case tried,
/// but is not proven. Source: E. Learned-Miller, P. S. Thomas, A new confidence interval for the
/// mean of a bounded random variable, arXiv 1905.06208, 2019; N. Gaffke, Three test statistics for
/// a nonparametric one-sided hypothesis on the mean of a nonnegative variable, 2005.
inline double gaffke_low(std::span<const double> values, double level) {
    constexpr std::uint32_t draws = 2000;
    std::vector<double> means;
    for (std::uint32_t draw = 0; draw < draws; ++draw) {
        const auto weight_of = [draw](std::uint64_t i) {
            return exponential(
                {.seed = 3, .replication = draw, .purpose = Purpose::order, .index = i});
        };
        double sum = 0, weights = weight_of(values.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double weight = weight_of(i);
            sum += weight * values[i];
            weights += weight;
        }
        means.push_back(sum / weights);
    }
    const auto rank = static_cast<std::ptrdiff_t>(level * draws);
    std::ranges::nth_element(means, means.begin() + rank);
    return means[static_cast<std::size_t>(rank)];
}

}  // namespace rovernet::test
