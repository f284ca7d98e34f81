// SPDX-License-Identifier: MIT
#pragma once

#include "study/advise/compare.hpp"
#include "study/store.hpp"
#include "study/study.hpp"

#include <functional>

namespace rovernet {

/// Measures what the models of a comparison cost, on the frames of replication 0 at the most
/// detailed model, and fills in ComparedModel::cost and radio_share and Comparison::cost_text.
/// Without a frame, or if that run fails, they stay empty.
/// @param study    whose points are the models
/// @param stopped  asked now and then; true ends the measurement, and nothing is filled in
void add_costs(Comparison& comparison, Study& study, const Store& store,
               const std::function<bool()>& stopped);

}  // namespace rovernet
