// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace rovernet {

/// Mean of an expensive model, told with the help of a cheap one on the same replications.
struct ControlVariate {
    double beta = 0;      ///< [-] cov(expensive, cheap) / var(cheap) over the pairs
    double rho = 0;       ///< [-] their correlation
    double estimate = 0;  ///< estimate of the expensive model's mean, in its unit
    double standard_error = 0;
    double standard_error_without = 0;  ///< standard error of the expensive runs alone
};

/// Estimates an expensive model's mean H from n of its runs and from m >= n of a cheap model C, the
/// first n of them on the same replications:
///
///   H = mean_n(H) + beta (mean_m(C) - mean_n(C)),
///   variance of it = var(H) / n * (1 - (1 - n / m) rho^2)
///
/// It is unbiased whatever the cheap model's error, but for O(1/n) from beta. Variances and beta
/// are over the n pairs. Source: B. Peherstorfer, K. Willcox, M. Gunzburger, Optimal model
/// management for multifidelity Monte Carlo estimation, SIAM J. Sci. Comput. 38(5), 2016.
///
/// @return nothing for fewer than 2 pairs, or if the values of one model are all equal
/// @throws std::invalid_argument if there are fewer cheap runs than expensive ones, or a value is
///         not finite
std::optional<ControlVariate> control_variate(std::span<const double> expensive,
                                              std::span<const double> cheap);

/// The best use of a cheap model beside an expensive one.
struct BestMix {
    double ratio = 1;   ///< [-] cheap runs for each expensive one: sqrt(w rho^2 / (1 - rho^2))
    double saving = 1;  ///< factor by which CPU time is divided [-] at equal error
};

/// Mix that gives the least standard error for a CPU time:
///   saving = 1 / (sqrt(1 - rho^2) + sqrt(rho^2 / w))^2.
///
/// Source: as control_variate(), theorem 3.4 and corollary 3.5.
/// @param  rho         [-] correlation, -1 < rho < 1
/// @param  cost_ratio  [-] w: cost of an expensive run over that of a cheap one, > 0
/// @return nothing where the cheap model saves nothing: saving <= 1. A ratio above 1, that is
///         w > (1 - rho^2) / rho^2, is not enough, as the cheap runs have to be paid for.
std::optional<BestMix> best_mix(double rho, double cost_ratio);

}  // namespace rovernet
