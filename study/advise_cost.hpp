// SPDX-License-Identifier: MIT
#pragma once

#include "study/advise.hpp"
#include "study/medium_cost.hpp"
#include "study/study.hpp"

#include <functional>
#include <optional>
#include <string>

namespace rovernet {

/// Measures what the candidates of an advice cost, on the transmissions of replication 0 at the
/// reference: CPU time of the medium alone, the path losses in alternation; and the CPU time of
/// their runs. Fills in JudgedCandidate::cost and mix, Advice::reference_cost and cost_text.
///
/// Another reception costs the medium the same: what it costs besides shows in the time of a run.
/// @param stopped  asked now and then; true ends the measurement, and nothing is filled in
void add_costs(Advice& advice, Study& study, const Store& store,
               const std::function<bool()>& stopped);

/// Advice in a sentence that a user can act on: what to choose, how sure that is, and what it
/// saves.
std::string advice_text(const Advice& advice);

/// What the most helpful candidate saves who wants the reference's mean: the best mix of both as a
/// control variate. Without costs, the one with the highest correlation.
std::string control_variate_text(const Advice& advice);

}  // namespace rovernet
