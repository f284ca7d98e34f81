// SPDX-License-Identifier: MIT
#pragma once

#include "study/advise/advise.hpp"
#include "study/advise/medium_cost.hpp"
#include "study/study.hpp"

#include <functional>
#include <string>

namespace rovernet {

/// Measures the costs of an advice's candidates, and fills in JudgedCandidate::cost,
/// Advice::reference_cost and cost_text:
///
/// - CPU time of the medium alone, for the transmissions of replication 0 of the reference. Path
///   losses are measured in turns. This time does not depend on the reception model.
/// - CPU time of whole runs of a few replications, without path planning. Candidates are measured
///   in turns. This time includes the cost of the reception model.
/// @param stopped  called repeatedly; returning true ends the measurement without costs
void add_costs(Advice& advice, Study& study, const std::function<bool()>& stopped);

/// Advice as sentences for the user: recommended models, confidence, saved CPU time, and undecided
/// candidates.
std::string advice_text(const Advice& advice);

}  // namespace rovernet
