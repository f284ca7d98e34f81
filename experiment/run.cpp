// SPDX-License-Identifier: MIT
#include "experiment/run.hpp"

#include "experiment/build.hpp"
#include "experiment/run_folder.hpp"
#include "experiment/session.hpp"
#include "experiment/summary.hpp"
#include "experiment/timeline.hpp"
#include "experiment/trace_files.hpp"
#include "experiment/version.hpp"
#include "experiment/warmup.hpp"
#include "files/part_file.hpp"
#include "mobility/kept_planners.hpp"
#include "scenario/document/json.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "traces/fingerprint.hpp"
#include "traces/topology.hpp"

#include <algorithm>

namespace rovernet {
namespace {

using WallClock = std::chrono::steady_clock;

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

ScenarioRun::ScenarioRun(const Scenario& scenario, KeptPlanners* kept)
    : scenario_(scenario), fingerprint_(std::make_shared<Fingerprint>()) {
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

RunResult run_scenario(const ScenarioFile& file, const Table& settings, const RunOptions& options) {
    return run_scenario(load_scenario(file, settings), options);
}

}  // namespace rovernet
