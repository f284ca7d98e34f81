// SPDX-License-Identifier: MIT
#pragma once

#include "study/statistics/interval.hpp"
#include "study/statistics/metric_bounds.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace rovernet {

/// Verdict on a mean difference D. within: |D| is below the margin. outside: |D| is above the
/// margin. undecided: the replications do not suffice for a verdict.
enum class Equivalence { undecided, within, outside };

/// Verdict on a mean difference, with its method and its number of replications.
struct EquivalenceVerdict {
    Equivalence verdict = Equivalence::undecided;
    IntervalMethod method{};  ///< method of the test, see method_for()
    /// Number of replications on which the verdict `within` or `outside` is based. The sequential
    /// method (IntervalMethod betting) may stop before the last replication; other methods use all
    /// replications. None: undecided.
    std::optional<std::size_t> decided_at;
    /// Predicted total number of replications for a verdict, if undecided and if further
    /// replications resemble the given ones. None if no prediction is possible, or if 100,000 (by
    /// STaR-Bets 10,000) would not suffice.
    std::optional<std::size_t> needed;
    /// Smallest margin that this number of replications can decide with 80 % power if the true
    /// difference is 0, in the metric's unit: half-width of the one-sided interval plus the 90 %
    /// quantile of the mean's normal error, since both sides must be rejected. None without an
    /// interval.
    std::optional<double> decidable;
    friend bool operator==(const EquivalenceVerdict&, const EquivalenceVerdict&) = default;
};

/// Sequential betting test whether a mean difference D lies within a margin, for any distribution:
/// four gamblers bet against "D >= margin", "D <= -margin", "D <= margin" and "D >= -margin".
/// Differences and margin are in units of the largest possible difference.
///
/// Let s = +-1 be the side and m = +-margin the limit on which a gambler bets. His wealth W starts
/// at 1, and each difference d changes it to
///   W (1 + lambda s (d - m)),
///   lambda = clip(s (mean - m) / (var + (mean - m)^2), 0, 0.9 / (1 + |m|)),
///   mean = (sum of the d before) / (r + 1),
///   var = (1/4 + sum (d_j - mean_j)^2) / (r + 1),
/// where r is the number of earlier differences, and mean_j the mean after d_j. If the hypothesis
/// against which a gambler bets is true, his wealth ever reaches 1/a with probability <= a (Ville's
/// inequality). Source: I. Waudby-Smith, A. Ramdas, Estimating means of bounded random variables by
/// betting, JRSS-B 86(1), 2024, section 4.
class EquivalenceTest {
  public:
    /// Index of the wealth of one of the four gamblers in the betting test. A large wealth is
    /// evidence for the condition at its index, where D is the true mean difference.
    enum Wealth : std::size_t {
        not_above,  ///< large wealth is evidence for D < margin
        not_below,  ///< large wealth is evidence for D > -margin
        above,      ///< large wealth is evidence for D > margin
        beneath     ///< large wealth is evidence for D < -margin
    };

    /// @param  margin  [-], above 0 and below 1
    /// @param  alpha   [-], in (0, 0.5): probability of at least one false verdict among `family`
    /// tests
    /// @throws std::invalid_argument unless margin and alpha are in range and family > 0
    EquivalenceTest(double margin, double alpha, std::size_t family);

    /// Adds the next difference. @param  difference  [-], -1 ... 1
    void add(double difference);

    /// Verdict of the test after the differences so far. The first verdict is final. It is
    /// - `within` if each of the wealths not_above and not_below has reached family / alpha at some
    ///   time
    /// - `outside` if the wealth above or the wealth beneath has reached 2 family / alpha
    Equivalence verdict() const { return verdict_; }
    double log_wealth(Wealth which) const { return log_wealth_[which]; }

  private:
    double margin_;
    double log_within_, log_outside_;  ///< logarithms of the wealth thresholds for each verdict
    double n_ = 0, sum_ = 0, squares_ = 0;
    std::array<double, 4> log_wealth_{}, log_most_{};
    Equivalence verdict_ = Equivalence::undecided;
};

/// Tests whether the true mean D of paired differences is between -margin and margin (verdict
/// within) or not (outside). If a study makes `family` such tests, the probability of at least one
/// false verdict is at most alpha.
///
/// Methods star and t: one test at the level L = alpha / family, with a number of replications
/// fixed beforehand. "Within": D >= margin and D <= -margin are both rejected at level L (TOST).
/// "Outside": D <= margin or D >= -margin is rejected at level L / 2. Method t assumes that means
/// are normal, and gives no verdict if all differences are equal. Source: D. J. Schuirmann, J.
/// Pharmacokinetics and Biopharmaceutics 15(6), 1987.
///
/// Method betting: an EquivalenceTest of the differences, valid at any stopping time.
///
/// @param  differences  in the metric's unit, in the order of the replications
/// @param  margin       > 0, in the metric's unit
/// @param  bounds       bounds of the metric itself, see bounds_of()
/// @param  alpha        [-], in (0, 0.5)
/// @param  family       number of simultaneous tests, > 0
/// @param  wish         preferred method, see method_for()
/// @throws std::invalid_argument if a difference is not finite, or a parameter is out of range
EquivalenceVerdict equivalence_of(std::span<const double> differences, double margin,
                                  const Bounds& bounds, double alpha = 0.05, std::size_t family = 1,
                                  std::optional<IntervalMethod> wish = {});

}  // namespace rovernet
