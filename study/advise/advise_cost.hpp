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
/// - CPU time of the medium alone, for the transmissions of replication 0 at the reference, with
///   path losses in alternation; it does not depend on the reception
/// - CPU time of whole runs of a few replications, in alternation, with paths already planned; it
///   includes the cost of the reception
/// @param stopped  called now and then; returning true ends the measurement, and nothing is filled
/// in
void add_costs(Advice& advice, Study& study, const std::function<bool()>& stopped);

/// Advice as a sentence for the user: recommended models, confidence, and saved time.
std::string advice_text(const Advice& advice);

}  // namespace rovernet
