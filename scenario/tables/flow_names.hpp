// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/tables/traffic_table.hpp"

#include <string_view>
#include <vector>

// Names of traffic flows. Metrics, results and pictures identify a flow by its name, which is the
// suffix of the names of its metrics: "delivery_ratio.A->all".

namespace rovernet {

/// Whether a text is a valid flow name: not empty, without commas, blanks and control characters,
/// which would break a list of metrics.
bool is_flow_name(std::string_view name);

/// Gives a name to each flow that has none: "A->B", "A->all". A second flow with the name "A->all"
/// is called "A->all#2". Invalid characters become "_".
/// @param all  all flows of a scenario, in their order
/// @throws InputError at the second of two flows with the same given name
void name_flows(std::vector<TrafficTable>& all);

}  // namespace rovernet
