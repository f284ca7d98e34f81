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

/// CPU cost of a candidate model, measured on this machine. No decision depends on it.
struct CandidateCost {
    double run_s = 0;  ///< [s] CPU time of a run, median; 0: not measured
    /// CPU time of the simulated medium for each transmission [s]: median, lowest and highest of
    /// the measurement turns.
    std::optional<double> transmission_s, low_s, high_s;
    std::optional<double> share;  ///< approximate share of the medium in a run's CPU time [-]
};

/// Models that differ between a candidate and the reference.
enum class AdviceStep { path_loss, reception, both };

/// Candidate (a path loss and a reception model) with its verdict against the reference.
struct JudgedCandidate {
    AdviceStep step{};
    std::size_t path_loss, reception;  ///< indices into the lists of AdviceCandidates
    std::string name;                  ///< name of the candidate: "log_distance + sinr"
    CandidateDecision decision;
    /// False: a cheaper candidate was found sufficient before this candidate had a verdict.
    bool needed = true;
    /// Means of D (candidate minus reference) and of |D|, in the metric's unit.
    double bias = 0, run_error = 0;
    /// Confidence interval of `bias` and of `run_error`, each alone at confidence 1 - alpha.
    std::optional<MeanInterval> bias_interval, run_error_interval;
    CandidateCost cost;
};

/// Advice on a scenario: the cheapest path loss and reception models whose results equal the
/// reference's within the tolerance.
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
    /// True: the comparison was stopped before all necessary verdicts; the choice is preliminary.
    bool stopped = false;
    CandidateCost reference_cost;
    std::string cost_text = {};  ///< text on how costs were measured; empty: not measured

    /// Whether the advice was stopped before any candidate was compared.
    bool knows_nothing() const;
    /// Verdict on the chosen models; null: the reference was chosen.
    const JudgedCandidate* chosen() const;
    /// Whether the reference costs hardly more than the choice: the medium takes at most 5 % of the
    /// reference's CPU time, or runs of the choice need more than 9/10 of the reference's CPU time.
    /// False if costs were not measured.
    bool saves_nothing() const;
};

/// Function that makes the missing runs of a study. @param replications  number of replications of
/// each point. @return false if it was stopped early; the advice then uses the existing runs. Its
/// exceptions end the advice
using MakeRuns = std::function<bool(const std::vector<std::uint32_t>& replications)>;

/// Compares the candidates with the reference: first path losses, then receptions, then both chosen
/// models together. Replications 0, 1, 2, ... are added in blocks until a candidate has a verdict,
/// or the choice no longer depends on it. A candidate that is undecided after `rule.most`
/// replications counts as insufficient. If the pair of chosen models is insufficient, the chosen
/// path loss is combined with the reference's reception.
///
/// Candidates that need few more replications come first: a block contains the candidates whose
/// predicted number of replications is at most 4 times the least. A candidate with 100 replications
/// and a prediction above `rule.most` gets no more: its error is too close to the tolerance.
///
/// The advice depends on results only, not on the number of workers, the speed of the machine or
/// the initial content of the store, unless make_runs() stops it.
/// @param store  store of a study over candidates.vary() and candidates.exclude()
Advice advise(const AdviceCandidates& candidates, const Store& store, const std::string& metric,
              const DecisionRule& rule, const MakeRuns& make_runs);

/// Number of replications after the next block, after n replications: 10 at first, then a quarter
/// more each time. Blocks are small because runs after a verdict within a block are wasted.
std::size_t next_block(std::size_t n, std::size_t most);

}  // namespace rovernet
