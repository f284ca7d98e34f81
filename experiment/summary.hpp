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
struct RunResult;
struct Scenario;

/// Appends the metrics to a table, as in summary.json and `rovernet trace stats --json`.
void append_metrics(Table& table, const MetricValues& metrics);

/// Calls visit(kind, name, metrics) for each flow ("flows") and each robot ("robots") whose metrics
/// [metrics] asks for, in order. The names follow from the scenario alone.
/// @param measured  duration of the measurement: the run without its warm-up
void for_each_part(const Scenario& scenario, const MetricValues& metrics, Duration measured,
                   const std::function<void(std::string_view kind, const std::string& name,
                                            const PartMetrics& metrics)>& visit);
/// Appends the metrics chosen in [metrics], as tables "flows", "robots" and "topology", and the
/// tables that were added to the run.
void append_parts(Table& table, const Scenario& scenario, const RunResult& result);

/// Document of the results without their timeline. Start time, duration and machine of the run are
/// only in summary.json.
Table run_summary(const Scenario& scenario, const RunResult& result);
/// Writes the results with their timeline as JSON, piece by piece: summary.json, and what `run
/// --json` prints.
/// @param more  further entries, which follow the results
void write_summary(const Scenario& scenario, const RunResult& result, const Write& write,
                   const Table& more = {});

}  // namespace rovernet
