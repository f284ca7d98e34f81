// SPDX-License-Identifier: MIT
#pragma once

#include "study/statistics/metric_bounds.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace rovernet {

/// Confidence interval for the mean of bounded values, in the unit of the values.
struct BoundedMean {
    double low = 0;
    double high = 0;
    friend bool operator==(const BoundedMean&, const BoundedMean&) = default;
};

/// Betting confidence sequence for the mean of independent, identically distributed values on [0,
/// 1] (values with other bounds are scaled). For any distribution, the intervals after 1, 2, 3, ...
/// values all cover the true mean with probability >= confidence. Hence sampling may stop as soon
/// as the interval is narrow. Its width is never 0.
///
/// A candidate mean m is rejected when the wealth of bets on "the true mean is above m" becomes
/// large. A gambler who stakes the share f of his wealth on each value x1, x2, ... has after n
/// values
///   W_f(m) = (1 + f (x1 / m - 1)) ... (1 + f (xn / m - 1)),
/// which is never negative, and a fair game if m is the mean. The wealth W(m) is the average over
/// 16 gamblers with f_k = (1 - cos((2 k - 1) pi / 32)) / 2, k = 1 ... 16: Jeffreys' prior on f. By
/// Ville's inequality, W(mean) ever reaches 1 / a with probability <= a. Each m for which W(m) has
/// reached 2 / (1 - confidence) lies below the interval. The same bets on 1 - x give the upper end.
/// Each factor of W falls with m, so that W falls with m. Hence the remaining m form an interval,
/// which bisection finds to 1e-12 of the range.
///
/// The result depends slightly on the order of the values, which should be that of the
/// replications. The interval is widened to contain the sample mean if necessary (values with a
/// drift can need it). The cost is about 1000 n multiplications. Source: I. Waudby-Smith, A.
/// Ramdas, Estimating means of bounded random variables by betting, JRSS-B 86(1), 2024, theorem 3
/// and section 4 (hedged bets); the prior: F. Orabona, K.-S. Jun, Tight concentrations and
/// confidence sequences from the regret of universal portfolio, IEEE Trans. Inf. Theory 70(1),
/// 2024.
///
/// @param  values  at least one, each within the bounds
/// @param  bounds  closed, low < high
/// @throws std::invalid_argument without values, without bounds, if a value is out of bounds, or
///         confidence is not in (0, 1)
BoundedMean bounded_mean(std::span<const double> values, const Bounds& bounds, double confidence);

/// Estimated total number of replications after which bounded_mean() gives an interval of width 2 *
/// wanted, if further values resemble the n given ones. This is the least N at which the wealth
/// W(m) of the gamblers suffices at both ends, if each gambler's wealth keeps its growth rate. The
/// estimate is rough: repeat it after more runs. The result is at least n; none if 10^9 would not
/// suffice.
/// @param  wanted  half-width > 0, in the metric's unit; other parameters as in bounded_mean()
std::optional<std::size_t> bounded_mean_replications(std::span<const double> values,
                                                     const Bounds& bounds, double wanted,
                                                     double confidence);

}  // namespace rovernet
