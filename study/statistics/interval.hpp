// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "study/statistics/metric_bounds.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace rovernet {

/// Method for the confidence interval of a mean. A study may choose it; otherwise it depends on the
/// metric, and on whether the number of replications is fixed beforehand.
///
/// - `t`: Student's t, which assumes that means are normal.
/// - `betting`: betting confidence sequence; assumes only that values are bounded, and is valid at
///   any stopping time.
/// - `star`: STaR-Bets; also assumes only bounded values, and is narrower, but needs a number of
/// values fixed beforehand.
///
/// [study] interval chooses the method; interval_of() computes the interval.
enum class IntervalMethod { t, betting, star };

inline constexpr std::array all_interval_methods = {IntervalMethod::t, IntervalMethod::betting,
                                                    IntervalMethod::star};

template <>
struct EnumNames<IntervalMethod> {
    static constexpr std::array<std::string_view, 3> values = {"t", "betting", "star"};
};

/// Interval for the true mean of a metric, in the metric's unit; low < high.
struct MeanInterval {
    double low = 0;
    double high = 0;
    IntervalMethod method{};  ///< method of the interval
    /// True: method t with values that are too skewed, see too_skewed_for_t().
    bool skewed = false;
    friend bool operator==(const MeanInterval&, const MeanInterval&) = default;

    double half_width() const { return (high - low) / 2; }
};

/// Interval method for these values: STaR-Bets if the metric has two bounds and the values keep
/// them, otherwise t. If `wish` is betting or STaR-Bets but the bounds are missing, the result is
/// t.
///
/// STaR-Bets is valid for a number of values fixed beforehand. Callers with a stopping rule must
/// wish for betting.
IntervalMethod method_for(std::span<const double> values, const Bounds& bounds,
                          std::optional<IntervalMethod> wish = {});

/// Interval for the mean, given one value from each replication. All tables, pictures and stopping
/// rules use it. None without values; by t also none for n = 1 or if all values are equal.
///
/// By STaR-Bets it is star_mean(), by betting bounded_mean(), both valid for any distribution. By t
/// it is mean +- half_width(), clipped to the bounds. It always contains the sample mean.
///
/// @param  values  in the order of the replications
/// @param  bounds  bounds of the metric: bounds_of(), or difference_bounds() for paired differences
/// @param  wish    preferred method, see method_for()
/// @throws std::invalid_argument if a value is not finite, or confidence not in (0, 1)
/// Example: examples/study.cpp.
std::optional<MeanInterval> interval_of(std::span<const double> values, const Bounds& bounds,
                                        double confidence = 0.95,
                                        std::optional<IntervalMethod> wish = {});

/// Estimated total number of replications for the half-width `wanted`, based on these values; none
/// if interval_of() gives none, or if 10^9 would not suffice. The estimate is rough: repeat it
/// after more runs. It assumes betting where interval_of() would use STaR-Bets, since repeated
/// estimates are a stopping rule.
/// @param  wanted  half-width > 0, in the metric's unit; other parameters as in interval_of()
std::optional<std::size_t> replications_for_width(std::span<const double> values,
                                                  const Bounds& bounds, double wanted,
                                                  double confidence = 0.95,
                                                  std::optional<IntervalMethod> wish = {});

/// Whether Student's interval is doubtful for these values: n <= 25 G^2, with G the sample
/// skewness, and |G| exceeds the limit that 95 % of normal samples keep, 2 sqrt(6 n (n - 1) / ((n -
/// 2) (n + 1) (n + 3))). False for n < 3.
///
/// G = (sum (x - mean)^3 / n) / (sum (x - mean)^2 / n)^1.5. Source: W. G. Cochran, Sampling
/// Techniques, 3rd ed., section 2.15 (n > 25 G^2); its standard error: D. N. Joanes, C. A. Gill,
/// The Statistician 47(1), 1998.
bool too_skewed_for_t(std::span<const double> values);

/// Interval method of this name, "t", "betting" or "star"; none without a name.
/// @throws std::invalid_argument for any other name
std::optional<IntervalMethod> method_named(const std::optional<std::string>& name);

/// Method as a phrase for captions: "by STaR-Bets", "by betting", "by Student's t".
std::string_view words_of(IntervalMethod method);

/// Notice that intervals of a metric do not use the requested method, with the reason; empty if
/// they do.
/// @param used  methods of the intervals
std::string other_method_text(std::string_view metric, std::optional<IntervalMethod> wish,
                              std::span<const IntervalMethod> used);

}  // namespace rovernet
