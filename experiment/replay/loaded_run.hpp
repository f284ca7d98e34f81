// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/recorded_scenario.hpp"
#include "network/network.hpp"
#include "scenario/scenario.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// Scenario of a recorded trace with its map, loaded once for all questions about the run.
struct LoadedRun {
    /// @param path  path of the trace, for errors
    /// @throws InputError if the trace has no scenario, the scenario cannot be loaded, or its
    /// robots are not those of the trace
    LoadedRun(const RecordedRun& run, const std::string& path);

    ReplayedScenario replayed;
    std::vector<std::string> names;  ///< names of robots, by NodeId
    Scenario scenario;
    NetworkSettings settings;
};

}  // namespace rovernet
