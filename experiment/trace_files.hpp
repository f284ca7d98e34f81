// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"
#include "sim/sink.hpp"

#include <functional>
#include <string>
#include <vector>

namespace rovernet {

/// A trace of a run.
struct TraceFile {
    std::string path;
    Sink sink;  ///< sink that writes it
    /// Gives the file its name, once the sink has finished. @throws RunError if that cannot be done
    std::function<void()> give_name;
};

/// The traces that the scenario asks for, in the folder of its results.
/// @throws RunError if one cannot be written
std::vector<TraceFile> trace_files(const Scenario& scenario, const std::string& folder);

/// Removes the traces of an earlier run into that folder that are not among `files`.
void remove_other_traces(const std::string& folder, const std::vector<TraceFile>& files);

}  // namespace rovernet
