// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

namespace rovernet {

/// Warm-up to be deleted at the start of a series of observations.
struct Truncation {
    std::size_t observations = 0;  ///< number of observations to delete, a multiple of 5
    bool conclusive = false;       ///< false: the series is too short; a longer run is needed
    friend bool operator==(const Truncation&, const Truncation&) = default;
};

/// Number of observations to delete at the start of a series (warm-up) so that the rest best
/// estimates the steady-state mean: the rule MSER-5.
///
/// Let Y1 ... Ym be the means of consecutive batches of 5; up to 4 observations at the end are
/// ignored. 5 d observations are deleted, with d the least number that minimises
///   z(d) = sum over i > d of (Yi - mean of Y(d+1) ... Ym)^2 / (m - d)^2,
/// the squared standard error of the remaining mean, up to a constant factor. d is searched from 0
/// to floor(m / 2): for larger d too few batches remain, and batches that are close by chance have
/// a small z. A minimum at the upper border is not conclusive. Fewer than 50 observations (m < 10,
/// so that fewer than 5 batches could remain) give 0, not conclusive.
///
/// The rule removes the initial bias of a series. It cannot detect a drift up to the end of the
/// series, or states that are rarer than the series is long (R. J. Wang, P. W. Glynn, ACM TOMACS
/// 27(1), 2016). Source: K. P. White, Simulation 69(6), 1997, for z(d); K. P. White, M. J. Cobb, S.
/// C. Spratt, Winter Simulation Conference 2000, for the batches of 5; K. Hoad, S. Robinson, R.
/// Davies, J. of the Operational Research Society 61(9), 2010, for the half and the last 5 batches.
///
/// @param  series  values at equal steps of one replication, or their mean over the replications
/// @throws std::invalid_argument if a value is not finite
Truncation mser5(std::span<const double> series);

}  // namespace rovernet
