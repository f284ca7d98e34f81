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

/// Result of a finished live run, whose result files are complete.
struct LiveResult {
    RunResult run;
    Scenario scenario;  ///< scenario that was run: a controller may have changed the seed
    std::string fault;  ///< error of an external program; empty: no error
    std::optional<Lateness> lateness = {};  ///< delays behind the clock; none: not paced
};

/// Rules for stopping a run early.
struct StopRules {
    std::function<bool()> go_on = [] {
        return true;
    };  ///< function called repeatedly during the run; returning false ends the run
    /// Reports whether the run may write files: called with false before the network is set up, and
    /// with true before the first file is written. The setup may take minutes and does not call
    /// `go_on`. Until the call with true, the process may be killed without leaving files.
    std::function<void(bool)> writes = [](bool) {};
};

/// Runs a scenario by the function `drive`, and writes the input log beside the other results.
/// @param prepare  called before the first event
/// @param drive    runs the session, see RunOptions::drive; called after all events of the start
/// time
/// @throws InputError, RunError; Interrupted if `drive` returns false, or if `stop` ends the run
///         before the call of `drive`
RunResult run_logged(const Scenario& scenario, const std::string& folder, const StopRules& stop,
                     const std::function<void(ScenarioRun&)>& prepare,
                     const std::function<bool(ScenarioRun&, InputLog&)>& drive);

}  // namespace rovernet
