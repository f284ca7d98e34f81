// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "study/statistics/equivalence.hpp"
#include "study/statistics/metric_bounds.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

// Decisions of `rovernet advise`: find the cheapest candidate whose error against the reference is
// within the tolerance. No function of this file runs a simulation.

namespace rovernet {

/// Criterion for accepting a candidate: the error that must not exceed the tolerance. D is the
/// value of a candidate minus the value of the reference in one replication; E is the expectation.
///
/// - `mean`: |E D|, the error of the mean of many runs, such as a curve in a paper
/// - `run`: E|D|, the mean error of a single run, such as the results of one robot
enum class ErrorCriterion { mean, run };
template <>
struct EnumNames<ErrorCriterion> {
    static constexpr std::array<std::string_view, 2> values = {"mean", "run"};
};

/// Rule by which a cheaper model (candidate) is accepted in place of the reference model: error
/// criterion, tolerance, and error probability.
struct DecisionRule {
    ErrorCriterion criterion = ErrorCriterion::mean;
    double tolerance = 0.02;  ///< largest accepted error, > 0, in the metric's unit
    Bounds bounds;            ///< bounds of the metric, see bounds_of()
    double alpha = 0.05;      ///< largest probability of any false verdict on the candidates [-]
    std::size_t family = 1;   ///< number of candidates that may be compared ("family")
    std::size_t most = 4000;  ///< largest number of replications for a candidate

    /// Whether verdicts use betting tests (see EquivalenceTest), which need two bounds of the
    /// metric. Otherwise verdicts use Student's intervals.
    bool by_betting() const { return bounds.closed(); }
};

/// Comparison of a candidate with the reference: values of both in each replication, and the first
/// verdict that these values give.
///
/// If the metric has two bounds, values are clipped to the bounds, and the verdict is that of an
/// EquivalenceTest of D = candidate - reference, or of |D| if the criterion is `run`. Since |D| is
/// never negative, only EquivalenceTest::above can falsely give "outside", so that the threshold
/// family / alpha suffices for this evidence. All verdicts of the `family` candidates are right
/// with probability 1 - alpha, for any distribution and any stopping time.
///
/// Otherwise Student's two-sided interval for the mean of D, or of |D|, is tested after 10, 20, 40,
/// ... and `most` pairs, at the level alpha / (family * number of tests). The verdict is "within"
/// if the interval lies inside the tolerance, and "outside" if it lies outside. If all differences
/// are equal, there is no verdict. Means are assumed to be normal.
class CandidateDecision {
  public:
    /// @throws std::invalid_argument if the rule's tolerance is not above 0, or not below the range
    ///         of a metric with two bounds, or for a value that EquivalenceTest rejects
    explicit CandidateDecision(const DecisionRule& rule);

    /// Adds the values of the next replication in which candidate and reference both have a value.
    void add(double candidate, double reference);

    Equivalence verdict() const { return verdict_; }
    /// Number of replications that gave the verdict; none: undecided.
    std::optional<std::size_t> decided_at() const { return decided_at_; }
    std::size_t n() const { return candidate_.size(); }
    /// Differences (candidate - reference), in the metric's unit, in the order of replications.
    std::vector<double> differences() const;
    /// Predicted total number of replications for a verdict, if further replications resemble the
    /// given ones. None if a verdict exists, if Student's interval is used, or if 100,000
    /// replications would not suffice.
    std::optional<std::size_t> needed() const;
    /// Smallest tolerance (with two digits) above the given one for which the given replications
    /// give the verdict "within". None if a verdict exists, or if no such tolerance is below the
    /// metric's range and below 1000 times the rule's tolerance.
    std::optional<double> deciding_tolerance() const;

  private:
    /// Verdict of the given replications under a different tolerance.
    Equivalence verdict_with(double tolerance) const;
    void bet(double error);
    void look(double error);
    /// Error of one replication by the criterion: candidate - reference (criterion `mean`), or the
    /// absolute value of this difference (criterion `run`).
    double error_of(double candidate, double reference) const;

    DecisionRule rule_;
    std::optional<EquivalenceTest> test_;  // betting test; none unless the metric has two bounds
    std::vector<double> candidate_, reference_, errors_;
    std::vector<std::size_t> looks_;  // numbers of pairs after which Student's interval is tested
    Equivalence verdict_ = Equivalence::undecided;
    std::optional<std::size_t> decided_at_;
};

/// Decisions on candidates of one kind (path loss or reception models), in the order of detail from
/// the cheapest. The reference is more detailed than all candidates.
class Ladder {
  public:
    Ladder(std::size_t candidates, const DecisionRule& rule);

    void add(std::size_t i, double candidate, double reference) {
        decisions_[i].add(candidate, reference);
    }
    /// Index of the cheapest candidate found within the tolerance so far; none: the reference is
    /// the choice.
    std::optional<std::size_t> choice() const;
    /// Whether the choice of a model still depends on candidate i: candidate i has no verdict, and
    /// no cheaper candidate is within the tolerance.
    bool wants(std::size_t i) const;
    /// Whether the choice of a model is final, since it depends on no further verdict.
    bool decided() const;

    std::size_t size() const { return decisions_.size(); }
    const CandidateDecision& operator[](std::size_t i) const { return decisions_[i]; }

  private:
    std::vector<CandidateDecision> decisions_;
};

}  // namespace rovernet
