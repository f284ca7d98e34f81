// SPDX-License-Identifier: MIT
#include "experiment/run.hpp"

#include "experiment/build.hpp"
#include "experiment/run_folder.hpp"
#include "experiment/session.hpp"
#include "experiment/trace_files.hpp"
#include "experiment/version.hpp"
#include "experiment/warmup.hpp"
#include "files/part_file.hpp"
#include "mobility/kept_planners.hpp"
#include "scenario/document/json.hpp"
#include "scenario/document/toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <unistd.h>

namespace rovernet {
namespace {

using WallClock = std::chrono::steady_clock;

}  // namespace

std::string utc_now() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", utc.tm_year + 1900, utc.tm_mon + 1,
                       utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec);
}

std::string host_name() {
    char name[256] = {};
    return gethostname(name, sizeof name - 1) == 0 ? name : "unknown";
}

namespace {

Table provenance(const RunResult& result) {
    Table table = build_provenance();
    table.set("host", host_name());
    table.set("started", result.started);
    table.set("wall_s", result.wall_s);
    return table;
}

Table whole_summary(const Scenario& scenario, const RunResult& result) {
    Table summary = run_summary(scenario, result);
    summary.set("scenario", to_document(scenario));
    summary.set("provenance", provenance(result));
    return summary;
}

void write_summary(const Table& summary, const Timeline& timeline, PartFile& file) {
    constexpr std::size_t portion = 65536;  // [bytes] that one call of the system writes
    std::string bytes;
    write_summary(summary, timeline, [&](std::string_view piece) {
        bytes += piece;
        if (bytes.size() >= portion) file.write(std::exchange(bytes, {}));
    });
    file.write(bytes);
}

/// Puts the results in the place of those of an earlier run, of which nothing is left.
void name_results(const std::string& folder, const std::vector<TraceFile>& traces,
                  std::initializer_list<PartFile*> files) {
    for (PartFile* file : files) file->close();
    const FolderLock lock(folder);
    remove_other_traces(folder, traces);
    for (const TraceFile& trace : traces) trace.give_name();
    for (PartFile* file : files) file->give_name();
}

/// The scenario as it was run, if the run ended early.
std::optional<Scenario> shortened(const Scenario& scenario, Duration simulated) {
    if (simulated >= scenario.scenario.duration) return std::nullopt;
    std::optional<Scenario> copy(scenario);
    copy->scenario.duration = simulated;
    return copy;
}

}  // namespace

ScenarioRun::ScenarioRun(const Scenario& scenario, KeptPlanners* kept) : scenario_(scenario) {
    result_.started = utc_now();
    NetworkSettings settings = network_settings(scenario);
    if (kept) settings.planners = kept->of(settings.scene);
    settings.warmup = warmup_ = warmup_of(scenario, settings);
    settings.scenario = [&scenario] { return to_toml(to_document(scenario)); };
    session_ = std::make_unique<Session>(scenario, settings);
    Network& network = session_->network();
    timeline_ = std::make_shared<Timeline>(network);
    network.add_sink(fingerprint_);
    network.add_sink(timeline_);
    topology_ = add_topology(network, scenario, warmup_);
}

ScenarioRun::~ScenarioRun() = default;

void ScenarioRun::write_to(const std::string& folder) {
    result_.folder = folder;
    make_folder(folder);
    traces_ = trace_files(scenario_, folder);
    for (const TraceFile& trace : traces_) session_->network().add_sink(trace.sink);
    if (!traces_.empty()) result_.trace = traces_.front().path;
}

RunResult ScenarioRun::finish() {
    Network& network = session_->network();
    result_.fingerprint = fingerprint_->text();
    network.finish();

    result_.simulated = network.now() - start_of_run;
    result_.metrics = network.metrics();
    const auto ended_early = shortened(scenario_, result_.simulated);
    append_parts(result_.parts, ended_early ? *ended_early : scenario_, network, result_.metrics,
                 std::max(result_.simulated - warmup_, Duration{0}), topology_.get());
    result_.events = network.events();
    result_.network = session_->shared_network();
    result_.interference_left_out = network.interference_left_out();
    result_.timeline = timeline_;
    result_.wall_s = std::chrono::duration<double>(WallClock::now() - begun_).count();
    if (!result_.folder.empty()) write_results();
    return std::move(result_);
}

void ScenarioRun::write_results() {
    const std::string& folder = result_.folder;
    PartFile document(folder + "/scenario.toml"), summary(folder + "/summary.json");
    document.write(to_toml(document_in(folder, scenario_)));
    write_summary(whole_summary(scenario_, result_), *timeline_, summary);
    name_results(folder, traces_, {&document, &summary});
}

RunResult run_scenario(const Scenario& scenario, const RunOptions& options) {
    ScenarioRun run(scenario);
    if (options.progress && !options.progress(0)) throw Interrupted();
    run.write_to(options.folder.value_or(run_folder(scenario, {})));
    const bool is_whole =
        options.drive ? options.drive(run) : run.session().run(options.speed, options.progress);
    if (!is_whole) throw Interrupted();
    return run.finish();
}

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
