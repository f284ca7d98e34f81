// SPDX-License-Identifier: MIT
#pragma once

#include "study/advise/advise_candidates.hpp"
#include "study/advise/advise_decision.hpp"
#include "study/control_variate.hpp"
#include "study/statistics/interval.hpp"
#include "study/store.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// What a model costs on this machine, now. No decision depends on it.
struct CandidateCost {
    double run_s = 0;  ///< [s] CPU time of a run, median; 0: not measured
    /// CPU time of the medium for each transmission [s]: median, lowest and highest turn.
    std::optional<double> transmission_s, low_s, high_s;
    std::optional<double> share;  ///< share of the medium in a run's CPU time [-], about
};

/// What differs between a candidate and the reference.
enum class AdviceStep { path_loss, reception, both };

/// A candidate that was judged against the reference.
struct JudgedCandidate {
    AdviceStep step{};
    std::size_t path_loss, reception;  ///< places in AdviceCandidates
    std::string name;                  ///< "log_distance + sinr"
    CandidateDecision decision;
    bool needed = true;  ///< false: a cheaper one was found sufficient before its verdict fell
    double bias = 0, run_error = 0;  ///< means of D and of |D|, in the metric's unit
    std::optional<MeanInterval> bias_interval, run_error_interval;  ///< each alone, at 1 - alpha
    CandidateCost cost;
    std::optional<ControlVariate> helper;  ///< of the reference's mean, by this candidate
    std::optional<BestMix> mix;            ///< at the costs of both
};

/// Advice on a scenario: the cheapest path loss and reception whose results are those of the
/// reference, within the tolerance.
struct Advice {
    std::string metric;
    DecisionRule rule;
    AdviceCandidates candidates;
    /// Candidates in the order in which they were judged: each path loss with the reference's
    /// reception (or the most detailed one that it goes with), then each reception with the
    /// reference's path loss, both in the order of their detail; then the cheapest of both
    /// together, unless that was judged already.
    std::vector<JudgedCandidate> judged;
    std::size_t path_loss, reception;  ///< the choice
    std::size_t replications = 0;      ///< replications of the reference
    bool stopped = false;  ///< ended before every verdict that the choice depends on: interim
    CandidateCost reference_cost;
    std::string cost_text = {};  ///< words on how costs were measured; empty: they were not

    /// The judgement that the choice rests on; null: the reference itself was chosen.
    const JudgedCandidate* chosen() const;
    /// Whether the reference costs hardly more than the choice: radio takes at most 5 % of its
    /// runs, or the choice's runs take more than 9/10 of their CPU time. False without costs.
    bool saves_nothing() const;
};

/// Makes the runs that a study's points lack: of each point so many replications. False: it was
/// stopped before they were there, and the advice is to be what is known by now. What it throws
/// ends the advice.
using MakeRuns = std::function<bool(const std::vector<std::uint32_t>& replications)>;

/// Judges the candidates: each on replications 0, 1, 2, ..., added in blocks; each stops with its
/// verdict, and all stop when the choice depends on none. First path losses, then receptions, then
/// the choice of both. What is undecided after `rule.most` replications counts as insufficient. If
/// the pair is insufficient, the chosen path loss keeps the reference's reception.
///
/// What is soon decided comes first: a block is of the candidates whose forecast is at most 4 times
/// the least. Once a candidate has 100 replications and its forecast is beyond `rule.most`, it gets
/// no more of them: it lies too near to the tolerance.
///
/// Depends on results alone: not on the number of workers, the speed of a machine, or what the
/// store has already; unless make_runs() stops it.
/// @param store  of a study over candidates.vary() and candidates.exclude()
Advice advise(const AdviceCandidates& candidates, const Store& store, const std::string& metric,
              const DecisionRule& rule, const MakeRuns& make_runs);

/// Number of replications after the next block, if there are n so far: 10 at first, then a quarter
/// more each time. Blocks are small, as a candidate whose verdict falls early in a block makes the
/// rest of it in vain.
std::size_t next_block(std::size_t n, std::size_t most);

}  // namespace rovernet
