// SPDX-License-Identifier: MIT
#pragma once

#include "study/advise/compare.hpp"
#include "study/store.hpp"
#include "study/study.hpp"

#include <functional>

namespace rovernet {

/// Measures the CPU cost of the compared models, on the frames of replication 0 of the most
/// detailed model. Fills in ComparedModel::cost, ComparedModel::radio_share and
/// Comparison::cost_text. These members stay empty if that replication fails or has no frames.
/// @param study    study whose points are the compared models
/// @param stopped  called repeatedly; returning true ends the measurement without costs
void add_costs(Comparison& comparison, Study& study, const Store& store,
               const std::function<bool()>& stopped);

}  // namespace rovernet
