// SPDX-License-Identifier: MIT
#pragma once

#include "study/advise/advise_candidates.hpp"
#include "study/advise/advise_decision.hpp"
#include "study/statistics/interval.hpp"
#include "study/store.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// CPU cost of a candidate model, measured on this machine. No decision depends on the cost.
struct CandidateCost {
    double run_s = 0;  ///< median CPU time of a run [s]; 0: not measured
    /// CPU time of the simulated medium for each transmission [s]: median, lowest and highest value
    /// over the measurement turns.
    std::optional<double> transmission_s, low_s, high_s;
    std::optional<double> share;  ///< approximate share of the medium in a run's CPU time [-]
};

/// Kind of models in which a candidate differs from the reference: path loss model, reception
/// model, or both.
enum class AdviceStep { path_loss, reception, both };

/// Candidate (a path loss and a reception model) with its verdict against the reference.
struct JudgedCandidate {
    AdviceStep step{};
    std::size_t path_loss, reception;  ///< indices of the two models in AdviceCandidates
    std::string name;                  ///< name of the candidate: "log_distance + sinr"
    CandidateDecision decision;
    /// True: the choice depends on this candidate. False: a cheaper candidate is sufficient.
    bool needed = true;
    /// Mean of D and mean of |D|, in the metric's unit. D is the value of the candidate minus the
    /// value of the reference in one replication.
    double bias = 0, run_error = 0;
    /// Confidence intervals of `bias` and of `run_error`. Each interval by itself has the
    /// confidence level 1 - DecisionRule::alpha.
    std::optional<MeanInterval> bias_interval, run_error_interval;
    CandidateCost cost;
};

/// Advice on a scenario: the cheapest path loss and reception models whose results differ from the
/// reference models' results by at most the tolerance.
struct Advice {
    std::string metric;
    DecisionRule rule;
    AdviceCandidates candidates;
    /// Candidates in the order in which they are compared. First each path loss with the
    /// reference's reception (or the most detailed reception that is compatible), in the order of
    /// detail. Then each reception with the reference's path loss. Last the chosen path loss with
    /// the chosen reception, unless compared already.
    std::vector<JudgedCandidate> judged;
    std::size_t path_loss, reception;  ///< indices of the chosen models
    std::size_t replications = 0;      ///< number of replications of the reference
    /// True: the comparison was stopped before all necessary verdicts, so that the choice is
    /// preliminary.
    bool stopped = false;
    CandidateCost reference_cost;
    std::string cost_text = {};  ///< text on how costs were measured; empty: not measured

    /// Whether the advice was stopped before any candidate was compared.
    bool knows_nothing() const;
    /// Judged candidate with the chosen path loss and reception; null if the reference is chosen.
    const JudgedCandidate* chosen() const;
    /// Whether the reference costs hardly more CPU time than the choice. True if the medium takes
    /// at most 5 % of the reference's CPU time, or runs of the choice need more than 9/10 of the
    /// reference's CPU time. False if costs were not measured, or if the reference was chosen.
    bool saves_nothing() const;
};

/// Function that makes the missing runs of a study, for advise(). Exceptions of the function end
/// the advice.
/// @param replications  requested number of replications of each point
/// @return false if the function was stopped early; the advice then uses the existing runs
using MakeRuns = std::function<bool(const std::vector<std::uint32_t>& replications)>;

/// Compares the candidates with the reference: first path losses, then receptions, then both chosen
/// models together. Replications 0, 1, 2, ... are added in blocks until each candidate has a
/// verdict, or the choice no longer depends on that candidate. A candidate that is undecided after
/// `rule.most` replications counts as insufficient. If the pair of chosen models is insufficient,
/// the chosen path loss is combined with the reference's reception.
///
/// Candidates that need few more replications come first. A block (group of runs made together)
/// contains the candidates whose predicted number of replications is at most 4 times the least. A
/// candidate with 100 replications and a prediction above `rule.most` gets no more runs, since its
/// error is too close to the tolerance.
///
/// The advice depends on results only, not on the number of workers, the speed of the machine or
/// the initial content of the store, unless make_runs() stops it.
/// @param store  store of a study over candidates.vary() and candidates.exclude()
Advice advise(const AdviceCandidates& candidates, const Store& store, const std::string& metric,
              const DecisionRule& rule, const MakeRuns& make_runs);

/// Number of replications at the end of the next block (group of runs made together), if n
/// replications exist: the larger of n + 10 and 5/4 n, but at most `most`. Blocks are small,
/// since runs after a verdict within a block are wasted.
std::size_t next_block(std::size_t n, std::size_t most);

}  // namespace rovernet
