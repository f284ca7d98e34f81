// SPDX-License-Identifier: MIT
#include "experiment/summary.hpp"

#include "experiment/run.hpp"
#include "experiment/timeline.hpp"
#include "network/network.hpp"
#include "scenario/document/json.hpp"
#include "scenario/scenario.hpp"
#include "traces/metric_values.hpp"
#include "traces/topology.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {

void append_metrics(Table& table, const MetricValues& m) {
    table.set("messages", m.messages);
    table.set("cut_off", m.cut_off);
    table.set("transmissions", m.transmissions);
    table.set("receptions", m.receptions);
    table.set("deliveries", m.deliveries);
    table.set("delivery_ratio", m.delivery_ratio);
    table.set("reach", m.reach);
    table.set("saved_rebroadcasts", m.saved_rebroadcasts);
    const auto latency = [&](double LatencyValues::*part) {
        return m.latency ? Value((*m.latency).*part) : Value();
    };
    table.set("latency_mean_s", latency(&LatencyValues::mean));
    table.set("latency_p50_s", latency(&LatencyValues::p50));
    table.set("latency_p95_s", latency(&LatencyValues::p95));
    table.set("latency_max_s", latency(&LatencyValues::max));
    table.set("hops_mean", m.mean_hops);
    table.set("hops_max", m.max_hops);
    Table drops;
    for (const auto& drop : m.drops) {
        if (drop.count > 0) drops.set(drop.reason, drop.count);
    }
    table.set("drops", std::move(drops));
}

namespace {

Table part_table(const PartValues& part, Duration measured) {
    Table table;
    table.set("messages", part.messages);
    table.set("deliveries", part.deliveries);
    table.set("delivery_ratio", part.delivery_ratio());
    const double bits = 8 * static_cast<double>(part.bytes);
    table.set("throughput_bps", measured > Duration{0} ? Value(bits / seconds(measured)) : Value());
    table.set("latency_mean_s", part.latency_mean());
    return table;
}

}  // namespace

void append_parts(Table& table, const Scenario& scenario, const Network& network,
                  const MetricValues& metrics, Duration measured, Topology* topology) {
    const auto part = [](const std::vector<PartValues>& all, std::size_t i) {
        return i < all.size() ? all[i] : PartValues{};
    };
    if (scenario.metrics.flows && !scenario.traffic.empty()) {
        Table flows;
        for (std::size_t i = 0; i < scenario.traffic.size(); ++i) {
            flows.entries.push_back(
                {scenario.traffic[i].name, part_table(part(metrics.flows, i), measured), {}});
        }
        table.set("flows", std::move(flows));
    }
    if (scenario.metrics.robots) {
        Table robots;
        for (NodeId n{0}; n.index() < network.size(); ++n.value) {
            robots.entries.push_back(
                {network.name(n), part_table(part(metrics.robots, n.index()), measured), {}});
        }
        table.set("robots", std::move(robots));
    }
    if (!scenario.metrics.topology) return;
    const Time end = start_of_run + scenario.scenario.duration;
    const TopologyValues values = topology ? topology->values(end) : TopologyValues{};
    Table list;
    list.set("degree_mean", values.degree_mean);
    list.set("components_mean", values.components_mean);
    list.set("speed_mean_m_s", values.speed_mean);
    list.set("link_lifetime_mean_s", values.link_lifetime_mean);
    list.set("links_ended", values.links_ended);
    table.set("topology", std::move(list));
}

std::shared_ptr<Topology> add_topology(Network& network, const Scenario& scenario,
                                       Duration warmup) {
    if (!scenario.metrics.topology) return nullptr;
    auto topology = std::make_shared<Topology>(start_of_run + warmup);
    network.add_sink(topology);
    return topology;
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
    for (const Entry& part : result.parts.entries) table.set(part.key, part.value);
    table.set("trace", result.trace ? Value(*result.trace) : Value());
    table.set("timeline", Array{});
    const std::uint64_t left_out = result.timeline ? result.timeline->left_out() : 0;
    if (left_out > 0) table.set("timeline_left_out", left_out);
    return table;
}

void write_summary(const Table& summary, const Timeline& timeline, const Write& write) {
    // A line that begins so is of the outermost table: texts have no ends of line.
    constexpr std::string_view empty = "\n  \"timeline\": []";
    const std::string all = to_json(summary);
    const std::size_t place = std::min(all.find(empty), all.size() - empty.size());
    if (timeline.size() == 0) return write(all);
    write(std::string_view(all).substr(0, place + empty.size() - 1));
    std::string piece;
    for (std::size_t i = 0; i < timeline.size(); ++i) {
        piece = i == 0 ? "\n    " : ",\n    ";
        timeline.append_json(i, piece);
        write(piece);
    }
    write("\n  ");
    write(std::string_view(all).substr(place + empty.size() - 1));
}

}  // namespace rovernet
