// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/kept_planners.hpp"
#include "scenario/scenario.hpp"
#include "traces/metric_values.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// A metric of a run; without a value where it is not defined, such as the latency of no delivery.
struct MetricValue {
    std::string name;
    std::optional<double> value;
    friend bool operator==(const MetricValue&, const MetricValue&) = default;
};

/// Metrics of summary.json as a list: its drops as "drops.DUP" and so on.
std::vector<MetricValue> metric_list(const MetricValues& values);

/// Measurement of one run: what a study keeps of it.
struct Measurement {
    std::vector<MetricValue> metrics;  ///< values in the order of metric_names()
    std::string fingerprint;
    double cpu_s = 0, wall_s = 0;  ///< [s] of this machine
    std::string started;           ///< UTC, ISO 8601
    std::string host;
    friend bool operator==(const Measurement&, const Measurement&) = default;
};

/// The metrics of every run: those of summary.json, its drops as "drops.DUP" and so on, its events,
/// and the time [s] from which on it is measured.
const std::vector<std::string>& metric_names();
/// Metrics of this scenario's runs: those of every run, and what its [metrics] asks for besides,
/// "delivery_ratio.FLOW" and "delivery_ratio.at.ROBOT", likewise messages, deliveries,
/// throughput_bps and latency_mean_s.
std::vector<std::string> metric_names(const Scenario& scenario);

/// @throws InputError at `where` unless a metric of the scenario has this name
void check_metric(const std::string& name, const Scenario& scenario, const Location& where);

/// Runs a scenario, without writing anything.
/// @param kept  what does not change from run to run in one scene; the result is the same without
/// @throws InputError, RunError
Measurement measure(const Scenario& scenario, KeptPlanners& kept);

/// The measurement as a text, and back; for pipes between processes.
std::string to_text(const Measurement& measurement);
Measurement measurement_of(std::string_view text);

}  // namespace rovernet
