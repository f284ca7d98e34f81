// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/tables/traffic_table.hpp"

#include <string_view>
#include <vector>

// Names of flows, which end the names of their metrics: "delivery_ratio.A->all". Metrics, results
// and pictures tell flows apart by them.

namespace rovernet {

/// Whether a text can name a flow: it is not empty and has no commas, blanks and control
/// characters, which would break a list of metrics.
bool is_flow_name(std::string_view name);

/// Names the flows that have no name: "A->B", "A->all"; the second of that name "A->all#2". A
/// character that a name may not have becomes "_".
/// @param all  flows of a scenario, in their order; read_scenario() gives all of them at once
/// @throws InputError at the second of two flows that were given the same name
void name_flows(std::vector<TrafficTable>& all);

}  // namespace rovernet
