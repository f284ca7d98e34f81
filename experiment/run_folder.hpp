// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// Folder for the results of a run, relative to the current folder: "runs/rescue-s1" for seed 1;
/// "runs/rescue-s1-r3" for replication 3; "runs/rescue-s1-radio.power=20dBm" with settings.
///
/// Runs with different settings have different folders. The name lists the settings sorted by key,
/// each once, and without blanks ("20dBm"). Characters that are unsuitable in a file name become
/// "_". A name with such characters, or with more than 80 characters, ends in a hash of the
/// settings.
/// @param set  assignments "path=value", see ScenarioOptions::set
std::string run_folder(const Scenario& scenario, const std::vector<std::string>& set);

/// Document of the scenario with file paths relative to `folder`. The document is a valid scenario
/// file in that folder.
Table document_in(const std::string& folder, Scenario scenario);

}  // namespace rovernet
