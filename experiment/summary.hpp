// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/output.hpp"
#include "scenario/document/value.hpp"
#include "sim/time.hpp"

#include <memory>

namespace rovernet {

class Network;
class Timeline;
class Topology;
struct MetricValues;
struct RunResult;
struct Scenario;

/// Appends the metrics to a table, as in summary.json and `rovernet trace stats --json`.
void append_metrics(Table& table, const MetricValues& metrics);

/// Appends the metrics chosen in [metrics], as tables "flows", "robots" and "topology".
/// @param measured  duration of the measurement: the run without its warm-up
/// @param topology  null: not measured
void append_parts(Table& table, const Scenario& scenario, const Network& network,
                  const MetricValues& metrics, Duration measured, Topology* topology);
/// Adds the topology sink to the network if [metrics] topology is true. @return the sink, or null
std::shared_ptr<Topology> add_topology(Network& network, const Scenario& scenario, Duration warmup);

/// Document of the results, printed by `run --json`. Start time, duration and machine of the run
/// are only in summary.json. The timeline is left empty: write_summary() writes it.
Table run_summary(const Scenario& scenario, const RunResult& result);
/// Writes a summary of run_summary() with its timeline as JSON, piece by piece.
void write_summary(const Table& summary, const Timeline& timeline, const Write& write);

}  // namespace rovernet
