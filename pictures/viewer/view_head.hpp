// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

struct Scenario;

/// Entries of a view file's head that follow from the scenario: description of the run, names of
/// the robots, colours, and words for outcomes (docs/formats/view-format.md).
/// @param robots   names of the robots by NodeId
/// @param version  version of the program that ran the scenario
Table view_head(const Scenario& scenario, const std::vector<std::string>& robots,
                std::string_view version);

}  // namespace rovernet
