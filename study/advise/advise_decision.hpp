// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "study/statistics/equivalence.hpp"
#include "study/statistics/metric_bounds.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

// Decisions of `rovernet advise`: which of several candidates, the cheapest first, is the first
// that comes near enough to the reference. Nothing here runs a simulation.

namespace rovernet {

/// Error that must not exceed the tolerance. With D = value of a candidate - value of the reference
/// in one replication:
///
/// - `mean`: |E D|, the error of the mean of many runs, such as a curve in a paper
/// - `run`: E|D|, the mean error of a single run, such as what becomes of one robot
enum class ErrorCriterion { mean, run };
template <>
struct EnumNames<ErrorCriterion> {
    static constexpr std::array<std::string_view, 2> values = {"mean", "run"};
};

/// Rule by which candidates are judged.
struct DecisionRule {
    ErrorCriterion criterion = ErrorCriterion::mean;
    double tolerance = 0.02;  ///< > 0, in the metric's unit
    Bounds bounds;            ///< of the metric: bounds_of()
    double alpha = 0.05;      ///< [-] probability of any false verdict among the family
    std::size_t family = 1;   ///< candidates that may be judged in all
    std::size_t most = 4000;  ///< replications

    /// Whether verdicts are by betting, as the metric has two bounds; else by Student's intervals.
    bool by_betting() const { return bounds.closed(); }
};

/// A candidate against the reference: the values of both, replication by replication, and the first
/// verdict that they give.
///
/// Where the metric has two bounds, values are cut at them, and the verdict is that of an
/// EquivalenceTest of D, or of |D| if the criterion is `run`: as |D| is never negative, only the
/// wealth `above` can wrongly say "outside", so that family / alpha is enough for it. All verdicts
/// of the family are right with a probability of 1 - alpha, whatever the distribution and whenever
/// one looks.
///
/// Elsewhere Student's interval for the mean of D, or of |D|, is looked at after 10, 20, 40, ...
/// and `most` pairs, two-sided at the level alpha / (family * looks). Within: it lies inside of the
/// tolerance; outside: it lies outside. Equal differences decide nothing. It supposes normal means.
class CandidateDecision {
  public:
    /// @throws std::invalid_argument unless the tolerance is above 0, and below the range of a
    ///         metric with two bounds; as EquivalenceTest
    explicit CandidateDecision(const DecisionRule& rule);

    /// Adds a replication: the next in their order in which both have a value.
    void add(double candidate, double reference);

    Equivalence verdict() const { return verdict_; }
    /// Pairs after which the verdict fell.
    std::optional<std::size_t> decided_at() const { return decided_at_; }
    std::size_t n() const { return candidate_.size(); }
    /// Differences D in the metric's unit, in the order of the replications.
    std::vector<double> differences() const;
    std::span<const double> candidate() const { return candidate_; }
    std::span<const double> reference() const { return reference_; }
    /// Pairs in all that would decide, if those to come were as these are; nothing if there is a
    /// verdict, if it goes by Student, or if 100,000 would not do.
    std::optional<std::size_t> needed() const;

  private:
    void bet(double error);
    void look(double error);
    /// Error that is judged: the difference, or its size.
    double error_of(double candidate, double reference) const;

    DecisionRule rule_;
    std::optional<EquivalenceTest> test_;  // where the metric has two bounds
    std::vector<double> candidate_, reference_, errors_;
    std::vector<std::size_t> looks_;  // where it has not: numbers of pairs
    Equivalence verdict_ = Equivalence::undecided;
    std::optional<std::size_t> decided_at_;
};

/// Candidates of one kind in the order of their detail, the cheapest first. Behind the last stands
/// the reference.
class Ladder {
  public:
    Ladder(std::size_t candidates, const DecisionRule& rule);

    void add(std::size_t i, double candidate, double reference) {
        decisions_[i].add(candidate, reference);
    }
    /// The cheapest candidate that is within the tolerance, as known now; nothing: the reference.
    std::optional<std::size_t> choice() const;
    /// Whether the choice still depends on a candidate: it has no verdict, and no cheaper one is
    /// within the tolerance. Order and cost on a clock play no part.
    bool wants(std::size_t i) const;
    /// Whether the choice depends on none.
    bool decided() const;

    std::size_t size() const { return decisions_.size(); }
    const CandidateDecision& operator[](std::size_t i) const { return decisions_[i]; }

  private:
    std::vector<CandidateDecision> decisions_;
};

}  // namespace rovernet
