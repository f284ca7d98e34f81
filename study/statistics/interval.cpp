// SPDX-License-Identifier: MIT
#include "study/statistics/interval.hpp"

#include "study/statistics/arguments.hpp"
#include "study/statistics/bounded_mean.hpp"
#include "study/statistics/star_bets.hpp"
#include "study/statistics/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace rovernet {
namespace {

std::optional<MeanInterval> student_interval(std::span<const double> values, const Bounds& bounds,
                                             double confidence) {
    const auto summary = summary_of(values);
    const auto half = half_width(*summary, confidence);
    if (!half || !(*half > 0)) return std::nullopt;
    constexpr double unbounded = std::numeric_limits<double>::infinity();
    // A bound that the values violate is ignored.
    const Bounds kept = bounds.hold(values) ? bounds : Bounds{};
    return MeanInterval{.low = std::max(summary->mean - *half, kept.low.value_or(-unbounded)),
                        .high = std::min(summary->mean + *half, kept.high.value_or(unbounded)),
                        .method = IntervalMethod::t,
                        .skewed = too_skewed_for_t(values)};
}

}  // namespace

IntervalMethod method_for(std::span<const double> values, const Bounds& bounds,
                          std::optional<IntervalMethod> wish) {
    if (!bounds.closed() || !bounds.hold(values)) return IntervalMethod::t;
    return wish.value_or(IntervalMethod::star);
}

std::optional<MeanInterval> interval_of(std::span<const double> values, const Bounds& bounds,
                                        double confidence, std::optional<IntervalMethod> wish) {
    check_finite(values, "interval");
    check_open_unit(confidence, "confidence", "interval");
    if (values.empty()) return std::nullopt;
    const IntervalMethod method = method_for(values, bounds, wish);
    if (method == IntervalMethod::t) return student_interval(values, bounds, confidence);
    const BoundedMean mean = method == IntervalMethod::betting
                                 ? bounded_mean(values, bounds, confidence)
                                 : star_mean(values, bounds, confidence);
    return MeanInterval{.low = mean.low, .high = mean.high, .method = method};
}

std::optional<std::size_t> replications_for_width(std::span<const double> values,
                                                  const Bounds& bounds, double wanted,
                                                  double confidence,
                                                  std::optional<IntervalMethod> wish) {
    const bool by_t = wish == IntervalMethod::t;
    const auto interval =
        interval_of(values, bounds, confidence, by_t ? wish : IntervalMethod::betting);
    if (!interval) return std::nullopt;
    if (interval->half_width() <= wanted) return values.size();
    if (interval->method == IntervalMethod::t) {
        return replications_needed(*summary_of(values), wanted, confidence);
    }
    return bounded_mean_replications(values, bounds, wanted, confidence);
}

bool too_skewed_for_t(std::span<const double> values) {
    const auto summary = summary_of(values);
    if (!summary || summary->n < 3 || *summary->standard_deviation == 0) return false;
    const auto n = static_cast<double>(summary->n);
    double squares = 0, cubes = 0;
    for (const double x : values) {
        const double z = (x - summary->mean) / *summary->standard_deviation;
        squares += z * z;
        cubes += z * z * z;
    }
    const double skewness = cubes / n / (squares / n * std::sqrt(squares / n));
    const double noise = std::sqrt(6 * n * (n - 1) / ((n - 2) * (n + 1) * (n + 3)));
    return std::abs(skewness) > 2 * noise && n <= 25 * skewness * skewness;
}

std::optional<IntervalMethod> method_named(const std::optional<std::string>& name) {
    if (!name) return std::nullopt;
    for (const IntervalMethod method : all_interval_methods) {
        if (name_of(method) == *name) return method;
    }
    throw std::invalid_argument(
        fmt::format("interval: found \"{}\"; expected t, betting or star", *name));
}

std::string_view words_of(IntervalMethod method) {
    switch (method) {
        case IntervalMethod::t: return "by Student's t";
        case IntervalMethod::betting: return "by betting";
        default: return "by STaR-Bets";
    }
}

std::string other_method_text(std::string_view metric, std::optional<IntervalMethod> wish,
                              std::span<const IntervalMethod> used) {
    const auto other =
        std::ranges::find_if(used, [&](IntervalMethod method) { return wish && method != *wish; });
    if (other == used.end()) return "";
    return fmt::format(
        "the intervals of {} are computed {}, not {} as requested: the requested method needs a "
        "metric with a lower and an upper bound, and all values within these bounds",
        metric, words_of(*other), words_of(*wish));
}

}  // namespace rovernet
