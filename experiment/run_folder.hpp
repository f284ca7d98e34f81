// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// Folder for the results of a run, relative to the current folder: "runs/rescue-s1"; with a
/// replication other than 0 "runs/rescue-s1-r3"; with settings "runs/rescue-s1-radio.power=20dBm".
///
/// Runs with different settings have different folders. Settings are sorted by key, each once;
/// blanks are removed ("20dBm"). Characters that are unsuitable in a file name become "_". A name
/// with such characters, or with more than 80 characters, ends in a hash of the settings.
/// @param set  assignments, see ScenarioOptions::set
std::string run_folder(const Scenario& scenario, const std::vector<std::string>& set);

/// Document of the scenario with file paths relative to `folder`, so that it can be run from there.
Table document_in(const std::string& folder, Scenario scenario);

}  // namespace rovernet
