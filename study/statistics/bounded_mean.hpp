// SPDX-License-Identifier: MIT
#pragma once

#include "study/statistics/metric_bounds.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace rovernet {

/// An interval for the mean of values that have bounds, in their unit.
struct BoundedMean {
    double low = 0;
    double high = 0;
    friend bool operator==(const BoundedMean&, const BoundedMean&) = default;
};

/// A confidence sequence for the mean of independent values from one distribution on [0, 1]
/// (others are scaled to it), whatever that distribution is: after every n, and after all of them
/// together, it covers the true mean with probability >= confidence. So one may look at it as often
/// as one likes and stop when it is narrow. Its width is never 0.
///
/// A candidate mean m is kept until somebody gets rich by betting that the true mean is above it.
/// After n values, a gambler who stakes the share f of his money on "above m" each time owns
///   W_f(m) = (1 + f (x1 / m - 1)) ... (1 + f (xn / m - 1)),
/// which is never negative and fair if m is the mean. The wealth W(m) is the average over 16
/// gamblers with f_k = (1 - cos((2 k - 1) pi / 32)) / 2, k = 1 ... 16: Jeffreys' prior on f. By
/// Ville's inequality W(mean) reaches 1 / a at any time at all with probability <= a; each m for
/// which W(m) has reached 2 / (1 - confidence) lies below the interval. Mirrored (1 - x for x), it
/// gives the upper end. Each factor falls with m, so W does, and the set of m that are left is an
/// interval, found by bisection to 1e-12 of the range.
///
/// The order of the values matters (slightly): give them in the order of the replications. The ends
/// are widened to hold the sample's mean where they would not, as values that drift can make them.
/// Costs about 1000 n multiplications. Source: I. Waudby-Smith, A. Ramdas, Estimating means of
/// bounded random variables by betting, JRSS-B 86(1), 2024, theorem 3 and section 4 (hedged bets);
/// the prior: F. Orabona, K.-S. Jun, Tight concentrations and confidence sequences from the regret
/// of universal portfolio, IEEE Trans. Inf. Theory 70(1), 2024.
///
/// @param  values  at least one, each within the bounds
/// @param  bounds  closed, low < high
/// @throws std::invalid_argument without values, without bounds, if a value is not within them, or
///         confidence is not in (0, 1)
BoundedMean bounded_mean(std::span<const double> values, const Bounds& bounds, double confidence);

/// Number of replications in all that would make the interval as narrow as 2 * wanted, if those to
/// come were as these are: the least N with W(m)^(N/n) large enough at both ends, each gambler's
/// wealth growing as fast as hitherto. Only an estimate: run more and ask again. At least n;
/// nothing if 10^9 would not do.
/// @param  wanted  half-width > 0, in the metric's unit; others as for bounded_mean()
std::optional<std::size_t> bounded_mean_replications(std::span<const double> values,
                                                     const Bounds& bounds, double wanted,
                                                     double confidence);

}  // namespace rovernet
