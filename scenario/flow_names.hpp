// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/traffic_table.hpp"

#include <string_view>
#include <vector>

namespace rovernet {

/// It can end the name of a metric: it has no blanks and commas.
bool is_flow_name(std::string_view name);

/// Names the flows that have no name: "A->B", "A->all"; the second of that name "A->all#2".
/// @throws InputError if two were given the same name
void name_flows(std::vector<TrafficTable>& all);

}  // namespace rovernet
