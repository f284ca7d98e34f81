// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

class KeptPlanners;
struct Location;
struct MetricValues;
struct Scenario;

/// Name and value of a metric of a run. An undefined metric has no value, such as the latency if no
/// message was delivered.
struct MetricValue {
    std::string name;
    std::optional<double> value;
    friend bool operator==(const MetricValue&, const MetricValue&) = default;
};

/// Metrics of summary.json as a list. Counts of dropped packets are named "drops.REASON", such as
/// "drops.DUP".
std::vector<MetricValue> metric_list(const MetricValues& values);

/// Measurement of one run, as stored by a study.
struct Measurement {
    std::vector<MetricValue> metrics;  ///< values of the metrics, in the order of metric_names()
    std::string fingerprint;
    double cpu_s = 0, wall_s = 0;  ///< CPU time and real time of the run on this machine [s]
    std::string started;           ///< start of the run in real time, UTC, ISO 8601
    std::string host;
    std::uint64_t searches = 0;  ///< number of path searches without a cached path; not stored

    /// Members except the metrics, in the order in which to_text() writes the members.
    static constexpr auto fields() {
        using M = Measurement;
        return describe(field("fingerprint", &M::fingerprint, "fingerprint of the run"),
                        field("cpu_s", &M::cpu_s, "CPU time"),
                        field("wall_s", &M::wall_s, "real time"),
                        field("started", &M::started, "start in real time, UTC"),
                        field("host", &M::host, "machine"),
                        field("searches", &M::searches,
                              "searches for paths whose results were not in the cache"));
    }
    friend bool operator==(const Measurement&, const Measurement&) = default;
};

/// Names of the metrics of every run: metrics of summary.json (counts of dropped packets as
/// "drops.REASON", such as "drops.DUP"), airtime, number of events, and end of the warm-up [s].
const std::vector<std::string>& metric_names();
/// Names of the metrics of a scenario's runs: metrics of every run, and metrics that the scenario
/// chooses in [metrics]. Metrics of a flow or robot, such as "delivery_ratio.FLOW" and
/// "delivery_ratio.at.ROBOT", exist for delivery_ratio, messages, deliveries, throughput_bps and
/// latency_mean_s.
std::vector<std::string> metric_names(const Scenario& scenario);

/// Checks that runs of the scenario have a metric with this name. @throws InputError at `where` if
/// there is no such metric
void check_metric(const std::string& name, const Scenario& scenario, const Location& where);

/// Suggestion of the few known metrics whose names are similar to `name`: "; did you mean
/// "deliveries" or "delivery_ratio"?". Empty if no name is similar.
std::string near_metrics(const std::string& name, std::vector<std::string> known);

/// Runs a scenario and returns its metrics and costs, without writing files.
/// @param kept  cache of path planners, shared by runs in one scene; it saves time and does not
///              affect results
/// @throws InputError, RunError
Measurement measure(const Scenario& scenario, KeptPlanners& kept);

/// Conversion of a measurement to a text; below, the inverse. Processes exchange measurements as
/// such texts.
std::string to_text(const Measurement& measurement);
Measurement measurement_of(std::string_view text);

}  // namespace rovernet
