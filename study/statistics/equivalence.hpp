// SPDX-License-Identifier: MIT
#pragma once

#include "study/statistics/interval_method.hpp"
#include "study/statistics/metric_bounds.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace rovernet {

/// Verdict of replications about a mean difference: it lies within the margin on both sides of 0,
/// it lies outside, or they do not decide it (yet).
enum class Equivalence { undecided, within, outside };

/// A verdict, and what it rests on.
struct EquivalenceVerdict {
    Equivalence verdict = Equivalence::undecided;
    IntervalMethod method{};  ///< see method_for()
    /// Replications after which it was decided: by betting the first verdict counts, else all.
    std::optional<std::size_t> decided_at;
    /// Number of replications in all that would decide, if there is no verdict and those to come
    /// are as these are. Nothing if they tell nothing, or 100,000 (by STaR-Bets 10,000) would not
    /// do.
    std::optional<std::size_t> needed;
    /// Least margin that as many such replications decide, with a power of 80 % where the true
    /// difference is 0, in the metric's unit: half the one-sided interval's width and the 90 %
    /// quantile of the mean's normal error, as both sides have to be. Nothing without an interval.
    std::optional<double> decidable;
    friend bool operator==(const EquivalenceVerdict&, const EquivalenceVerdict&) = default;
};

/// Sequential test whether a mean difference lies within a margin, without assuming a distribution:
/// four gamblers bet against "D >= margin", "D <= -margin", "D <= margin" and "D >= -margin" with D
/// the true mean. Differences and margin in units of the largest possible difference.
///
/// With s = +-1 the side and m = +-margin the edge that a gambler bets on, and mean and var known
/// from the differences before, his wealth W = 1 grows by each difference d to
///   W (1 + lambda s (d - m)),
///   lambda = clip(s (mean - m) / (var + (mean - m)^2), 0, 0.9 / (1 + |m|)),
///   mean = (sum of the d before) / (r + 1),
///   var = (1/4 + sum (d_j - mean_j)^2) / (r + 1),
/// where r is the number of the d before, and mean_j the mean just after d_j. By Ville's inequality
/// a wealth reaches 1/a at any time at all with probability <= a if what it bets against is true.
/// Source: I. Waudby-Smith, A. Ramdas, Estimating means of bounded random variables by betting,
/// JRSS-B 86(1), 2024, section 4.
class EquivalenceTest {
  public:
    /// Wealths of the four gamblers: a large one says that the true mean D lies as written here.
    enum Wealth : std::size_t {
        not_above,  ///< D < margin
        not_below,  ///< D > -margin
        above,      ///< D > margin
        beneath     ///< D < -margin
    };

    /// @param  margin  [-], above 0 and below 1
    /// @param  alpha   [-], in (0, 0.5): the probability of any false verdict among `family` tests
    /// @throws std::invalid_argument unless both are in these ranges and family > 0
    EquivalenceTest(double margin, double alpha, std::size_t family);

    /// @param  difference  [-], -1 ... 1
    void add(double difference);

    /// The first verdict: within if not_above and not_below have each reached family / alpha at
    /// some time, outside if above or below has reached 2 family / alpha.
    Equivalence verdict() const { return verdict_; }
    double log_wealth(Wealth which) const { return log_wealth_[which]; }

  private:
    double margin_;
    double log_within_, log_outside_;  ///< thresholds
    double n_ = 0, sum_ = 0, squares_ = 0;
    std::array<double, 4> log_wealth_{}, log_most_{};
    Equivalence verdict_ = Equivalence::undecided;
};

/// Whether the true mean of paired differences lies within `margin` of 0. Of all studies in which
/// `family` such questions are asked, at most a share alpha has any false verdict.
///
/// By STaR-Bets and by t at one look, each test at the level alpha / family: within if both
/// one-sided tests (TOST) reject, outside if one of the two tests for beyond the margin does at
/// half that level. Both hold for a number of replications that was fixed before; t supposes normal
/// means, and equal differences decide nothing by it. Source: D. J. Schuirmann, J. Pharmacokinetics
/// and Biopharmaceutics 15(6), 1987.
///
/// By betting it is an EquivalenceTest over the replications in their order; the guarantee holds
/// however often one looks and whenever one stops.
///
/// @param  differences  in the metric's unit, in the order of the replications
/// @param  margin       > 0, in the metric's unit
/// @param  bounds       of the metric itself: bounds_of()
/// @param  alpha        [-], in (0, 0.5)
/// @param  family       > 0, how many questions are asked together
/// @param  wish         for the method: see method_for()
/// @throws std::invalid_argument if a difference is not finite, or a parameter is out of range
EquivalenceVerdict equivalence_of(std::span<const double> differences, double margin,
                                  const Bounds& bounds, double alpha = 0.05, std::size_t family = 1,
                                  std::optional<IntervalMethod> wish = {});

}  // namespace rovernet
