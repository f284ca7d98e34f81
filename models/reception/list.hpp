// SPDX-License-Identifier: MIT
#pragma once

#include "models/reception/collision.hpp"
#include "models/reception/judge.hpp"
#include "models/reception/sinr.hpp"

#include <tuple>

// List of reception models: a new model is a header and a line here.

namespace rovernet {

/// Reception models that scenario files can name, in the order of detail; the first one is the
/// default, and the last one is the most detailed. A reception model decides the fate of a frame at
/// a receiver in range. Reading, checks and printing of its settings follow from its fields().
using ReceptionModels = std::tuple<Threshold, Collision, Sinr>;

}  // namespace rovernet
