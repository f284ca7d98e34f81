// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"
#include "sim/sink.hpp"

#include <functional>
#include <string>
#include <vector>

namespace rovernet {

/// Trace file of a run, while it is written.
struct TraceFile {
    std::string path;
    Sink sink;  ///< sink that writes the file
    /// Function that renames the file to its final name; called when the sink has finished.
    /// @throws RunError if the file cannot be renamed
    std::function<void()> give_name;
};

/// Opens the trace files that the table [trace] of the scenario requests, in the folder of the
/// results. Removes unfinished trace files of a killed run from the folder.
/// @throws RunError if a trace cannot be written
std::vector<TraceFile> trace_files(const Scenario& scenario, const std::string& folder);

/// Removes the trace files that an earlier run left in a folder, except `files`.
void remove_other_traces(const std::string& folder, const std::vector<TraceFile>& files);

}  // namespace rovernet
