// SPDX-License-Identifier: MIT
#include "study/statistics/mser5.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace rovernet {
namespace {

constexpr std::size_t batch_size = 5;
constexpr std::size_t least_batches = 10;

double batch_mean(std::span<const double> series, std::size_t batch) {
    double sum = 0;
    for (const double x : series.subspan(batch * batch_size, batch_size)) sum += x;
    return sum / static_cast<double>(batch_size);
}

}  // namespace

Truncation mser5(std::span<const double> series) {
    for (const double x : series) {
        if (!std::isfinite(x)) {
            throw std::invalid_argument(fmt::format("mser5: values must be finite, got {}", x));
        }
    }
    const std::size_t batches = series.size() / batch_size;
    if (batches < least_batches) return {};
    const std::size_t border = batches / 2;
    std::size_t best = border;
    double least = std::numeric_limits<double>::infinity();
    // The batches are taken from the end on: each updates the mean and the sum of squares of those
    // behind.
    double mean = 0, squares = 0, count = 0;
    for (std::size_t d = batches; d-- > 0;) {
        const double y = batch_mean(series, d);
        const double before = y - mean;
        ++count;
        mean += before / count;
        squares += before * (y - mean);
        const double z = squares / (count * count);
        if (d <= border && z <= least) {
            least = z;
            best = d;
        }
    }
    return {.observations = best * batch_size, .conclusive = best < border};
}

}  // namespace rovernet
