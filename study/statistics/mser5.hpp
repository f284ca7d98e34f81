// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

namespace rovernet {

/// Start of a series that is left out.
struct Truncation {
    std::size_t observations = 0;  ///< observations to delete, a multiple of 5
    bool conclusive = false;       ///< false: the series is too short to tell, make it longer
    friend bool operator==(const Truncation&, const Truncation&) = default;
};

/// Number of observations to delete at the start of a series so that what remains tells most about
/// its steady state: the rule MSER-5.
///
/// The means Y1 ... Ym of consecutive batches of 5 are made, up to 4 observations at the end
/// staying out; 5 d observations are deleted, with d the least that minimises
///   z(d) = sum over i > d of (Yi - mean of Y(d+1) ... Ym)^2 / (m - d)^2,
/// the squared standard error of the remaining mean but for a constant. d is searched from 0 to
/// floor(m / 2): later, too few batches remain, and some that happen to be close have a small z.
/// A minimum at that border may lie beyond it, and is not conclusive. Fewer than 50 observations
/// (m < 10: d could leave fewer than 5 batches) give 0, not conclusive.
///
/// It removes the bias that one series shows; a drift to its end or beyond, and states rarer than
/// the series is long, it cannot see (R. J. Wang, P. W. Glynn, ACM TOMACS 27(1), 2016).
/// Source: K. P. White, Simulation 69(6), 1997, for z(d); K. P. White, M. J. Cobb, S. C. Spratt,
/// Winter Simulation Conference 2000, for the batches of 5; K. Hoad, S. Robinson, R. Davies, J. of
/// the Operational Research Society 61(9), 2010, for the half and the last 5 batches.
///
/// @param  series  values at equal steps of one replication, or their mean over the replications
/// @throws std::invalid_argument if a value is not finite
Truncation mser5(std::span<const double> series);

}  // namespace rovernet
