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

/// Method for the confidence interval of a mean. A study may choose the method. Otherwise it
/// depends on the metric, and on whether the number of replications is fixed beforehand.
///
/// - `t`: Student's t, which assumes that means are normal.
/// - `betting`: betting confidence sequence; assumes only that values are bounded, and is valid at
///   any stopping time.
/// - `star`: STaR-Bets; also assumes only that values are bounded; gives narrower intervals than
///   betting, but needs a number of values fixed beforehand.
///
/// The key interval of [study] chooses the method. The function interval_of() computes the
/// interval.
enum class IntervalMethod { t, betting, star };

inline constexpr std::array all_interval_methods = {IntervalMethod::t, IntervalMethod::betting,
                                                    IntervalMethod::star};

/// Names of the methods in scenario files and on the command line.
template <>
struct EnumNames<IntervalMethod> {
    static constexpr std::array<std::string_view, 3> values = {"t", "betting", "star"};
};

/// Interval for the true mean of a metric, in the metric's unit; low < high.
struct MeanInterval {
    double low = 0;
    double high = 0;
    IntervalMethod method{};  ///< method of the interval
    /// True: the method is t although the values are too skewed for it, see too_skewed_for_t().
    bool skewed = false;
    friend bool operator==(const MeanInterval&, const MeanInterval&) = default;

    double half_width() const { return (high - low) / 2; }
};

/// Method of the confidence interval for the mean of values. If the metric has two bounds and all
/// values lie within the bounds, the method is `wish`, or STaR-Bets if no method is wished.
/// Otherwise the method is t.
///
/// STaR-Bets is valid for a number of values fixed beforehand. Callers that let the values decide
/// when to stop must wish for betting.
IntervalMethod method_for(std::span<const double> values, const Bounds& bounds,
                          std::optional<IntervalMethod> wish = {});

/// Confidence interval for the true mean of a metric, from one value for each replication. All
/// tables, pictures and stopping rules use this function. None without values; by t also none for
/// n = 1 or if all values are equal.
///
/// The interval is star_mean() by STaR-Bets and bounded_mean() by betting, both valid for any
/// distribution. By t it is mean +- half_width(), clipped to the bounds. The interval always
/// contains the sample mean.
///
/// @param  values  in the order of the replications
/// @param  bounds  bounds of the metric: bounds_of(), or difference_bounds() for paired differences
/// @param  wish    preferred method, see method_for()
/// @throws std::invalid_argument if a value is not finite, or confidence not in (0, 1)
/// Example: examples/study.cpp.
std::optional<MeanInterval> interval_of(std::span<const double> values, const Bounds& bounds,
                                        double confidence = 0.95,
                                        std::optional<IntervalMethod> wish = {});

/// Estimated total number of replications for an interval with the half-width `wanted`, based on
/// the given values. None if interval_of() gives none, or if 10^9 would not suffice. The estimate
/// is rough: repeat it after more runs. Betting is assumed where interval_of() would use STaR-Bets,
/// since repeated estimates are a stopping rule.
/// @param  wanted  half-width > 0, in the metric's unit; other parameters as in interval_of()
std::optional<std::size_t> replications_for_width(std::span<const double> values,
                                                  const Bounds& bounds, double wanted,
                                                  double confidence = 0.95,
                                                  std::optional<IntervalMethod> wish = {});

/// Whether Student's interval is doubtful for values, since their sample skewness G is large:
/// - n <= 25 G^2, and
/// - |G| exceeds 2 sqrt(6 n (n - 1) / ((n - 2) (n + 1) (n + 3))), the limit that 95 % of samples
///   of normal values do not exceed.
/// False for n < 3.
///
/// G = (sum (x - mean)^3 / n) / (sum (x - mean)^2 / n)^1.5. Source: W. G. Cochran, Sampling
/// Techniques, 3rd ed., section 2.15 (n > 25 G^2); its standard error: D. N. Joanes, C. A. Gill,
/// The Statistician 47(1), 1998.
bool too_skewed_for_t(std::span<const double> values);

/// Interval method with the given name: "t", "betting" or "star"; none if no name is given.
/// @throws std::invalid_argument for any other name
std::optional<IntervalMethod> method_named(const std::optional<std::string>& name);

/// Interval method as a phrase for captions: "by STaR-Bets", "by betting", "by Student's t".
std::string_view words_of(IntervalMethod method);

/// Notice that intervals of a metric do not use the requested method `wish`, with the reason. Empty
/// if all intervals use `wish`, or if no method is requested.
/// @param used  methods of the intervals
std::string other_method_text(std::string_view metric, std::optional<IntervalMethod> wish,
                              std::span<const IntervalMethod> used);

}  // namespace rovernet
