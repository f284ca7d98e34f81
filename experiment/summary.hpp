// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/output.hpp"
#include "scenario/document/value.hpp"
#include "sim/time.hpp"

#include <functional>
#include <string>
#include <string_view>

namespace rovernet {

struct MetricValues;
struct PartMetrics;
struct PartValues;
struct RunResult;
struct Scenario;

/// Appends the metrics of a run to a table, in the form of summary.json and of `rovernet trace
/// stats --json`.
void append_metrics(Table& table, const MetricValues& metrics);

/// Calls visit(kind, name, metrics, routed) for each flow (kind "flows") and each robot (kind
/// "robots"), in their order, if the table [metrics] of the scenario requests metrics of flows or
/// robots. Names depend only on the scenario.
/// @param measured  duration of the run without its warm-up [ns]
/// @param visit     `routed` has the values of a flow of unicasts that may go over several hops;
///                  `routed` is null for other flows, and for robots
void for_each_part(
    const Scenario& scenario, const MetricValues& metrics, Duration measured,
    const std::function<void(std::string_view kind, const std::string& name,
                             const PartMetrics& metrics, const PartValues* routed)>& visit);
/// Appends the metrics that the table [metrics] of the scenario requests, as tables "flows",
/// "robots" and "topology". Appends also the tables that were added by ScenarioRun::add_part().
void append_parts(Table& table, const Scenario& scenario, const RunResult& result);

/// Document of a run's results, without the timeline. It does not include the start in real time
/// and the name of the machine; only summary.json contains these.
Table run_summary(const Scenario& scenario, const RunResult& result);
/// Writes a run's results with the timeline as JSON, piece by piece. This JSON text is the content
/// of summary.json, and the output of `rovernet run --json`.
/// @param more  further entries, which are written after the results
void write_summary(const Scenario& scenario, const RunResult& result, const Write& write,
                   const Table& more = {});

}  // namespace rovernet
