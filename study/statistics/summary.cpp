// SPDX-License-Identifier: MIT
#include "study/statistics/summary.hpp"

#include "study/statistics/arguments.hpp"
#include "study/statistics/distributions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rovernet {
namespace {

constexpr std::size_t most_replications = 1'000'000'000;

double student_half_width(double standard_deviation, std::size_t n, double confidence) {
    const auto count = static_cast<double>(n);
    return t_critical(count - 1, 1 - confidence) * standard_deviation / std::sqrt(count);
}

}  // namespace

std::optional<Summary> summary_of(std::span<const double> values) {
    check_finite(values, "summary");
    if (values.empty()) return std::nullopt;
    // The first value is one of them: the shifted mean is of the size of their spread.
    const double shift = values[0];
    const auto n = static_cast<double>(values.size());
    double sum = 0, squares = 0;
    for (const double x : values) sum += x - shift;
    const double mean = sum / n;
    for (const double x : values) squares += (x - shift - mean) * (x - shift - mean);
    const auto [min, max] = std::ranges::minmax(values);
    Summary summary{
        .n = values.size(), .mean = shift + mean, .standard_deviation = {}, .min = min, .max = max};
    if (n > 1) summary.standard_deviation = std::sqrt(squares / (n - 1));
    return summary;
}

std::optional<double> half_width(const Summary& summary, double confidence) {
    check_open_unit(confidence, "confidence", "half_width");
    if (!summary.standard_deviation) return std::nullopt;
    return student_half_width(*summary.standard_deviation, summary.n, confidence);
}

std::optional<std::size_t> replications_needed(const Summary& summary, double wanted,
                                               double confidence) {
    check_open_unit(confidence, "confidence", "replications_needed");
    if (!(wanted > 0)) {
        throw std::invalid_argument(
            fmt::format("replications_needed: the half-width must be > 0, got {}", wanted));
    }
    if (!summary.standard_deviation) return std::nullopt;
    const auto enough = [&](std::size_t n) {
        return student_half_width(*summary.standard_deviation, n, confidence) <= wanted;
    };
    if (enough(summary.n)) return summary.n;
    std::size_t few = summary.n, many = most_replications;
    if (!enough(many)) return std::nullopt;
    while (many - few > 1) {
        const std::size_t middle = few + (many - few) / 2;
        (enough(middle) ? many : few) = middle;
    }
    return many;
}

}  // namespace rovernet
