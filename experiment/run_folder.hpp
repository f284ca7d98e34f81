// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"
#include "scenario/document/value.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// Folder for the results of a run, below the current one: "runs/rescue-s1", with a replication
/// other than 0 "runs/rescue-s1-r3", with settings "runs/rescue-s1-radio.power=20dBm".
///
/// Runs with other settings have another folder. Settings come in the order of their keys, each
/// once; "20 dBm" loses its blank. Characters that do not belong in a file's name become "_". With
/// such characters, or with more than 80 in all, the folder's name ends in a digest of the
/// settings.
/// @param set  as in ScenarioOptions
std::string run_folder(const Scenario& scenario, const std::vector<std::string>& set);

/// The scenario as a document that can be run from `folder`: its files are named from there.
Table document_in(const std::string& folder, Scenario scenario);

}  // namespace rovernet
