// SPDX-License-Identifier: MIT
#pragma once

#include "study/statistics/bounded_mean.hpp"
#include "study/statistics/metric_bounds.hpp"

#include <cstddef>
#include <optional>
#include <span>

// STaR-Bets: tests and intervals for the mean of n values with two bounds, n fixed beforehand.
// Whoever looks earlier, or adds values because of what he saw, needs bounded_mean() instead.
//
// A gambler bets against "the mean is at most m" in each of n rounds. With W = 1 his wealth at
// first and x in [0, 1] the value of a round, a stake lambda >= 0 that the earlier rounds decide
// makes it
//   W (1 + lambda (x - m)),   lambda <= 1 / m.
// It is never negative and does not grow on average where the mean is at most m, so that it reaches
// 1 / level with probability <= level (Ville). The guarantee needs no more: neither a distribution
// nor a good stake. A good stake aims at the target and knows the rounds that are left:
//   lambda = sqrt(2 ln(1 / (level W)) / (rounds left * V)),
// with V the variance that the values have if their mean is m. He stops when he has 1 / level,
// and stakes 1 / m in the last round, where nothing but the target counts.
// Source: V. Voracek, F. Orabona, STaR-Bets: Sequential target-recalculating bets for tighter
// confidence intervals, NeurIPS 2025 (arXiv 2505.22422).
//
// V is our own: with q the earlier values and half a value at each bound, V is the variance about m
// of the distribution that is nearest to q in Kullback's sense among those of mean m, with weights
//   q / (1 + kappa (x - m)), kappa >= 0 such that their mean is m (0 if q's is below).
// The half value at the lower bound stands for the loss that did not happen yet: a share that was 1
// in every run so far has V = m (1 - m) by it, and the gambler does not stake everything. V is
// taken anew each time that the earlier values are a quarter more.

namespace rovernet {

/// Whether these values refute "the mean is at most m" at a level.
/// @param  values  in [0, 1], in the order of the replications
/// @param  m       in (0, 1]
/// @param  level   in (0, 1): probability of a refutation if it is true, at most
bool star_refutes(std::span<const double> values, double m, double level);

/// Interval for the mean of values with two bounds, n of them fixed beforehand: it covers the true
/// mean with probability >= confidence, whatever the distribution. Its width is never 0.
///
/// It consists of the means that the bets of both sides do not refute, each at half of the rest of
/// confidence. All m in a cell of the scale, 1 / (2 n) wide (1/512 at least, 1/128 at most), are
/// bet against with the stakes for the cell's upper end: then wealth falls with m in a cell, and
/// the least m that is left is found exactly. The ends are widened to hold the sample's mean where
/// they would not.
///
/// The order of the values matters (slightly): give them in the order of the replications. Takes
/// about 1 ms for 100 values, 20 ms for 1000.
/// @param  values  at least one, each within the bounds
/// @throws std::invalid_argument as bounded_mean()
BoundedMean star_mean(std::span<const double> values, const Bounds& bounds, double confidence);

}  // namespace rovernet
