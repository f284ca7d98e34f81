// SPDX-License-Identifier: MIT
#pragma once

#include "study/statistics/bounded_mean.hpp"
#include "study/statistics/metric_bounds.hpp"

#include <span>

// STaR-Bets: tests and intervals for the mean of n bounded values, with n fixed beforehand. If
// results are examined earlier, or values are added because of the results, bounded_mean() must be
// used instead.
//
// A gambler bets against "the mean is at most m" in each of n rounds. His wealth W starts at 1. The
// value x in [0, 1] of a round, with a stake lambda >= 0 that depends on earlier rounds only,
// changes it to
//   W (1 + lambda (x - m)),   lambda <= 1 / m.
// W is never negative and does not grow on average if the mean is at most m, so that it reaches 1 /
// level with probability <= level (Ville). This holds for any distribution and any stake. A good
// stake depends on the target 1 / level and on the number of rounds left:
//   lambda = sqrt(2 ln(1 / (level W)) / (rounds left * V)),
// with V the variance that the values have if their mean is m. The gambler stops at the wealth 1 /
// level, and stakes 1 / m in the last round, since a smaller gain is worthless then. Source: V.
// Voracek, F. Orabona, STaR-Bets: Sequential target-recalculating bets for tighter confidence
// intervals, NeurIPS 2025 (arXiv 2505.22422).
//
// The estimate of V is not from that paper. Let q be the empirical distribution of the earlier
// values and half a value at each bound. V is the variance about m of the distribution with mean m
// that is nearest to q in Kullback-Leibler divergence, with weights
//   q / (1 + kappa (x - m)), kappa >= 0 such that their mean is m (0 if q's is below).
// The half value at the lower bound accounts for losses that did not happen yet: if all values so
// far were 1, then V = m (1 - m), and the gambler does not stake everything. V is updated each time
// the number of earlier values has grown by a quarter.

namespace rovernet {

/// Whether the STaR-Bets test of the values rejects the hypothesis "the mean is at most m".
/// @param  values  in [0, 1], in the order of the replications
/// @param  m       in (0, 1]
/// @param  level   in (0, 1): largest probability of a rejection if the hypothesis is true
bool star_refutes(std::span<const double> values, double m, double level);

/// STaR-Bets confidence interval for the mean of n bounded values, n fixed beforehand. It covers
/// the true mean with probability >= confidence, for any distribution. Its width is never 0.
///
/// The interval consists of the means m that neither the bets on a larger nor the bets on a smaller
/// mean reject at the level (1 - confidence) / 2. The range of m, scaled to 0 ... 1, is divided
/// into cells of width 1 / (2 n), limited to 1/512 ... 1/128. All m of a cell use the stakes for
/// the cell's upper end, so that the wealth falls with m within a cell, and the least remaining m
/// is found exactly. The interval is widened to contain the sample mean if necessary.
///
/// The result depends slightly on the order of the values, which should be that of the
/// replications. The computation takes about 1 ms for 100 values, 20 ms for 1000.
/// @param  values  at least one, each within the bounds
/// @throws std::invalid_argument as bounded_mean()
BoundedMean star_mean(std::span<const double> values, const Bounds& bounds, double confidence);

}  // namespace rovernet
