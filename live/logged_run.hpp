// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/run.hpp"
#include "live/lateness.hpp"
#include "scenario/scenario.hpp"

#include <functional>
#include <optional>
#include <string>

namespace rovernet {

class InputLog;

/// Live run that has ended; its results are written.
struct LiveResult {
    RunResult run;
    Scenario scenario;  ///< as it ran: a controller may have asked for another seed
    std::string fault;  ///< what went wrong with a program outside; empty if nothing did
    std::optional<Lateness> lateness = {};  ///< of a run by the clock
};

/// How a run ends early, and what is at stake then.
struct StopRules {
    std::function<bool()> go_on = [] { return true; };  ///< asked now and then; false ends the run
    /// Told true when the run begins to write, and false while a network is set up: that is not
    /// asked `go_on`, may take minutes, and leaves nothing if the process ends meanwhile.
    std::function<void(bool)> writes = [](bool) {};
};

/// Runs a scenario by `drive`, and writes the log of its inputs beside the other results.
/// @param drive  as RunOptions::drive; the session has served all events of its start
/// @throws InputError, RunError; Interrupted if `drive` returns false, or before it is called
RunResult run_logged(const Scenario& scenario, const std::string& folder, const StopRules& stop,
                     const std::function<bool(ScenarioRun&, InputLog&)>& drive);

}  // namespace rovernet
