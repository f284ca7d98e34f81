// SPDX-License-Identifier: MIT
#include "experiment/trace_files.hpp"

#include "experiment/recorded_scenario.hpp"
#include "experiment/version.hpp"
#include "files/part_file.hpp"
#include "traces/ns2/ns2_trace.hpp"
#include "traces/recorded/recorded_trace.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <utility>

namespace rovernet {
namespace {

constexpr const char* ns2_name = "/trace.tr";
constexpr const char* recorded_name = "/trace.mcap";
constexpr const char* inputs_name = "/inputs.jsonl";  // of a live run, which writes it itself

Ns2Trace ns2_trace(const TraceTable& table, const std::string& path) {
    const bool is_old = table.ns2 == Ns2Choice::old_format;
    return Ns2Trace(path, is_old ? Ns2Format::old_format : Ns2Format::new_format,
                    table.mac ? MacTrace::on : MacTrace::off);
}

}  // namespace

std::vector<TraceFile> trace_files(const Scenario& scenario, const std::string& folder) {
    std::vector<TraceFile> files;
    // A killed run leaves them; those of inputs.jsonl can be played again.
    for (const char* name : {ns2_name, recorded_name}) remove_orphans(folder + name);
    if (scenario.trace.ns2 != Ns2Choice::none) {
        const std::string path = folder + ns2_name;
        const auto trace = std::make_shared<Ns2Trace>(ns2_trace(scenario.trace, path));
        files.push_back({path, trace, [trace] { trace->close(); }});
    }
    if (scenario.trace.record) {
        const std::string path = folder + recorded_name;
        RecordedScenario stored = recorded_scenario(scenario, folder);
        const auto trace = std::make_shared<RecordedTrace>(
            path, RecordedTrace::Contents{.version = code_version(),
                                          .scenario = std::move(stored.text),
                                          .walls = std::move(stored.walls),
                                          .files = std::move(stored.files),
                                          .links = scenario.trace.links});
        files.push_back({path, trace, [trace] { trace->close(); }});
    }
    return files;
}

void remove_other_traces(const std::string& folder, const std::vector<TraceFile>& files) {
    for (const char* name : {ns2_name, recorded_name, inputs_name}) {
        const std::string path = folder + name;
        const bool is_written = std::any_of(files.begin(), files.end(),
                                            [&](const TraceFile& f) { return f.path == path; });
        if (!is_written) std::remove(path.c_str());
    }
}

}  // namespace rovernet
