// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "scenario/scenario.hpp"

namespace rovernet {

/// Adds notices about keys that are given but have no effect, because a different key or model
/// would have to be chosen: `ttl` under protocol dsr, `standard` without csma, `range` with a
/// scheme other than location, `arp_timeout` without `arp`, `links` of [trace] without a trace,
/// materials on an open field.
///
/// A parameter of a model that is not chosen gives no notice if it has its default value, as in
/// printed scenarios, if the study varies the model, or if only the command line chose the model.
/// @param document  document from which the scenario was read
void note_idle_keys(const Value& document, Scenario& scenario);

}  // namespace rovernet
