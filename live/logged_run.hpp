// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/run.hpp"
#include "live/lateness.hpp"
#include "scenario/scenario.hpp"

#include <functional>
#include <optional>
#include <string>

namespace rovernet {

/// Live run that has ended; its results are written.
struct LiveResult {
    RunResult run;
    Scenario scenario;  ///< as it ran: a controller may have asked for another seed
    std::string fault;  ///< what went wrong with a program outside; empty if nothing did
    std::optional<Lateness> lateness = {};  ///< of a run by the clock
};

/// Runs a scenario by `drive`, and writes the log of its inputs beside the other results.
/// @param drive  as RunOptions::drive
/// @throws InputError, RunError; Interrupted if `drive` returns false
RunResult run_logged(const Scenario& scenario, const std::string& folder,
                     const std::function<bool(ScenarioRun&)>& drive);

}  // namespace rovernet
