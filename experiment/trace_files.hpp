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
    /// Gives the file its final name, once the sink has finished. @throws RunError if that fails
    std::function<void()> give_name;
};

/// Opens the traces that [trace] lists, in the folder of the results. Removes unfinished trace
/// files of a killed run.
/// @throws RunError if a trace cannot be written
std::vector<TraceFile> trace_files(const Scenario& scenario, const std::string& folder);

/// Removes the traces that an earlier run left in that folder, except `files`.
void remove_other_traces(const std::string& folder, const std::vector<TraceFile>& files);

}  // namespace rovernet
