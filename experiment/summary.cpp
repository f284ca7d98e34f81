// SPDX-License-Identifier: MIT
#include "experiment/summary.hpp"

#include "experiment/run.hpp"
#include "experiment/timeline.hpp"
#include "scenario/document/json.hpp"
#include "scenario/names.hpp"
#include "scenario/scenario.hpp"
#include "traces/metric_fold.hpp"
#include "traces/metric_values.hpp"
#include "traces/topology.hpp"

#include <map>
#include <type_traits>
#include <utility>
#include <vector>

namespace rovernet {

namespace {

template <Described T>
Table metrics_table(const T& values) {
    Table table;
    for_each_metric(values, [&]<class V>(std::string_view name, const V& value) {
        if constexpr (std::is_same_v<V, DropCounts>) {
            Table counts;
            for (const DropCount& each : value)
                if (each.count > 0) counts.set(each.reason, each.count);
            table.set(name, std::move(counts));
        } else {
            table.set(name, value);
        }
    });
    return table;
}

/// Appends the metrics of the routed unicasts of a flow.
void append_routed(Table& part, const PartValues& values) {
    for (Entry& entry : metrics_table(metrics_of(values.routed)).entries)
        part.set(entry.key, std::move(entry.value));
    Table drops;
    for (std::size_t i = 0; i < values.drops.size(); ++i)
        if (values.drops[i] > 0) drops.set(loss_codes.of[i], values.drops[i]);
    part.set("drops", std::move(drops));
}

}  // namespace

void append_metrics(Table& table, const MetricValues& metrics) {
    for (Entry& entry : metrics_table(metrics).entries)
        table.set(entry.key, std::move(entry.value));
}

void for_each_part(const Scenario& scenario, const MetricValues& metrics, Duration measured,
                   const std::function<void(std::string_view, const std::string&,
                                            const PartMetrics&, const PartValues*)>& visit) {
    const auto part = [&](const std::vector<PartValues>& all, std::size_t i) {
        return i < all.size() ? all[i] : PartValues{};
    };
    if (scenario.metrics.flows) {
        for (std::size_t i = 0; i < scenario.traffic.size(); ++i) {
            const PartValues values = part(metrics.flows, i);
            const bool is_routed =
                metrics.routed && scenario.traffic[i].to && !scenario.traffic[i].hops;
            visit("flows", scenario.traffic[i].name, values.metrics(measured),
                  is_routed ? &values : nullptr);
        }
    }
    if (!scenario.metrics.robots) return;
    const std::vector<std::string> robots = robot_names(scenario);
    for (std::size_t i = 0; i < robots.size(); ++i)
        visit("robots", robots[i], part(metrics.robots, i).metrics(measured), nullptr);
}

void append_parts(Table& table, const Scenario& scenario, const RunResult& result) {
    std::map<std::string_view, Table> kinds;
    for_each_part(scenario, result.metrics, result.measured(),
                  [&](std::string_view kind, const std::string& name, const PartMetrics& metrics,
                      const PartValues* routed) {
                      Table part = metrics_table(metrics);
                      if (routed) append_routed(part, *routed);
                      kinds[kind].entries.push_back({name, std::move(part), {}});
                  });
    for (auto& [kind, parts] : kinds) table.set(kind, std::move(parts));
    if (result.topology) table.set("topology", metrics_table(*result.topology));
    for (const Entry& part : result.added.entries) table.set(part.key, part.value);
}

Table run_summary(const Scenario& scenario, const RunResult& result) {
    Table table;
    table.set("name", scenario.scenario.name);
    table.set("seed", scenario.scenario.seed);
    table.set("replication", scenario.scenario.replication);
    table.set("fingerprint", result.fingerprint);
    table.set("sim_s", seconds(result.simulated));
    table.set("wall_s", result.wall_s);
    table.set("events", result.events);
    if (result.interference_left_out) {
        table.set("interference_left_out_db", result.interference_left_out->value);
    }
    append_metrics(table, result.metrics);
    for (Entry& entry : metrics_table(result.airtime).entries)
        table.set(entry.key, std::move(entry.value));
    append_parts(table, scenario, result);
    table.set("trace", result.trace ? Value(*result.trace) : Value());
    return table;
}

void write_summary(const Scenario& scenario, const RunResult& result, const Write& write,
                   const Table& more) {
    JsonObjectWriter json(write);
    for (const Entry& entry : run_summary(scenario, result).entries)
        json.set(entry.key, entry.value);
    const Timeline* timeline = result.timeline.get();
    json.set_list("timeline", timeline ? timeline->size() : 0,
                  [&](std::size_t i, std::string& out) { timeline->append_json(i, out); });
    if (timeline && timeline->left_out() > 0) json.set("timeline_left_out", timeline->left_out());
    for (const Entry& entry : more.entries) json.set(entry.key, entry.value);
    json.end();
}

}  // namespace rovernet
