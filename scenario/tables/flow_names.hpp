// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/tables/traffic_table.hpp"

#include <string_view>
#include <vector>

// Names of flows. Metrics, results and pictures identify a flow by its name, which is a suffix of
// its metrics: "delivery_ratio.A->all".

namespace rovernet {

/// Whether a text is a valid flow name: not empty, without commas, blanks and control characters,
/// which would break a list of metrics.
bool is_flow_name(std::string_view name);

/// Gives a name to each flow without one: "A->B", "A->all"; a second flow of that name becomes
/// "A->all#2". Invalid characters become "_".
/// @param all  all flows of a scenario, in their order
/// @throws InputError at the second of two flows with the same given name
void name_flows(std::vector<TrafficTable>& all);

}  // namespace rovernet
