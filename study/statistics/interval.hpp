// SPDX-License-Identifier: MIT
#pragma once

#include "study/statistics/interval_method.hpp"
#include "study/statistics/metric_bounds.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace rovernet {

/// An interval for the true mean of a metric, in its unit; low < high.
struct MeanInterval {
    double low = 0;
    double high = 0;
    IntervalMethod method{};  ///< method by which it was made
    bool skewed = false;      ///< made by t of values too skewed for it: see too_skewed_for_t()
    friend bool operator==(const MeanInterval&, const MeanInterval&) = default;

    double half_width() const { return (high - low) / 2; }
};

/// The method for these values: STaR-Bets where the metric has two bounds and the values keep them,
/// else t. A wish for betting or STaR-Bets where it cannot be gives t.
///
/// STaR-Bets hold for a number of values that was fixed beforehand. Who stops when he has seen
/// enough wishes for betting.
IntervalMethod method_for(std::span<const double> values, const Bounds& bounds,
                          std::optional<IntervalMethod> wish = {});

/// The interval for the mean of one value from each replication; every table, picture and stopping
/// rule has its intervals from here. Nothing without values, and by t nothing for n = 1 or if all
/// values are equal: where nothing varied, t knows nothing.
///
/// By STaR-Bets it is that of star_mean(), by betting that of bounded_mean(), whatever the
/// distribution. By t it is mean +- half_width(), cut at the bounds; the mean always lies in it.
///
/// @param  values  in the order of the replications
/// @param  bounds  of the metric: bounds_of(), or difference_bounds() for paired differences
/// @param  wish    method_for() otherwise
/// @throws std::invalid_argument if a value is not finite, or confidence not in (0, 1)
std::optional<MeanInterval> interval_of(std::span<const double> values, const Bounds& bounds,
                                        double confidence = 0.95,
                                        std::optional<IntervalMethod> wish = {});

/// Number of replications in all that, as far as these tell, give half the width `wanted`; nothing
/// if they tell nothing (see interval_of()) or 10^9 would not do. An estimate: run more and ask
/// again, and so by betting where interval_of() would take STaR-Bets.
/// @param  wanted  > 0, in the metric's unit; others as for interval_of()
std::optional<std::size_t> replications_for_width(std::span<const double> values,
                                                  const Bounds& bounds, double wanted,
                                                  double confidence = 0.95,
                                                  std::optional<IntervalMethod> wish = {});

/// Whether Student's interval for the mean of these is doubtful: n <= 25 G^2 with G their skewness,
/// and |G| more than normal values show in 95 % of samples, 2 sqrt(6 n (n - 1) / ((n - 2) (n + 1)
/// (n + 3))). False for n < 3.
///
/// G = (sum (x - mean)^3 / n) / (sum (x - mean)^2 / n)^1.5. Source: W. G. Cochran, Sampling
/// Techniques, 3rd ed., section 2.15 (n > 25 G^2); its standard error: D. N. Joanes, C. A. Gill,
/// The Statistician 47(1), 1998.
bool too_skewed_for_t(std::span<const double> values);

/// The method of this name, "t", "betting" or "star"; nothing for no name.
/// @throws std::invalid_argument for any other
std::optional<IntervalMethod> method_named(const std::optional<std::string>& name);

/// The method in words, for captions: "by STaR-Bets", "by betting", "by Student's t".
std::string_view words_of(IntervalMethod method);

}  // namespace rovernet
