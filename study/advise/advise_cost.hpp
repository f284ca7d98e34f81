// SPDX-License-Identifier: MIT
#pragma once

#include "study/advise/advise.hpp"
#include "study/advise/medium_cost.hpp"
#include "study/study.hpp"

#include <functional>
#include <optional>
#include <string>

namespace rovernet {

/// Measures what the candidates of an advice cost, and fills in JudgedCandidate::cost and mix,
/// Advice::reference_cost and cost_text:
///
/// - CPU time of the medium alone, on the transmissions of replication 0 at the reference, the path
///   losses in alternation; another reception costs the medium the same
/// - CPU time of whole runs of a few replications, in alternation, after their ways were planned:
///   what a reception costs shows in it
/// @param stopped  asked now and then; true ends the measurement, and nothing is filled in
void add_costs(Advice& advice, Study& study, const std::function<bool()>& stopped);

/// Advice in a sentence that a user can act on: what to choose, how sure that is, and what it
/// saves.
std::string advice_text(const Advice& advice);

/// Sentence on what the most helpful candidate saves if the reference's mean is wanted: the best
/// mix of both as a control variate. Without costs, it is the candidate with the highest
/// correlation.
std::string control_variate_text(const Advice& advice);

}  // namespace rovernet
