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
#include "files/kept_inputs.hpp"
#include "files/part_file.hpp"
#include "mobility/kept_planners.hpp"
#include "scenario/document/json.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "traces/fingerprint.hpp"
#include "traces/topology.hpp"

#include <algorithm>
#include <sstream>

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

void write_summary(const Scenario& scenario, const RunResult& result, PartFile& file) {
    constexpr std::size_t portion = 65536;  // [bytes] that one call of the system writes
    Table more;
    more.set("scenario", to_document(scenario));
    more.set("provenance", provenance(result));
    std::string bytes;
    write_summary(
        scenario, result,
        [&](std::string_view piece) {
            bytes += piece;
            if (bytes.size() >= portion) file.write(std::exchange(bytes, {}));
        },
        more);
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

}  // namespace

ScenarioRun::ScenarioRun(const Scenario& scenario, KeptPlanners* kept, Observed observed,
                         const std::function<Router()>& router)
    : scenario_(scenario) {
    result_.started = utc_now();
    NetworkSettings settings = network_settings(scenario);
    if (kept) settings.planners = planners_ = kept->of(settings.scene);
    if (planners_) searched_ = planners_->searches();
    if (observed < Observed::metrics) result_.warmup = warmup_of(scenario, settings, router);
    settings.metrics = observed != Observed::nothing;
    settings.warmup = result_.warmup;
    settings.scenario = [&scenario] { return to_toml(to_document(scenario)); };
    session_ = std::make_unique<Session>(scenario, settings,
                                         router ? std::optional(router()) : std::nullopt);
    observe(observed);
}

/// Adds the sinks. The network calls them in this order.
void ScenarioRun::observe(Observed observed) {
    if (observed >= Observed::metrics) return;
    Network& network = session_->network();
    network.add_sink(fingerprint_ = std::make_shared<Fingerprint>());
    if (observed == Observed::everything)
        network.add_sink(timeline_ = std::make_shared<Timeline>(network));
    if (scenario_.metrics.topology)
        network.add_sink(topology_ = std::make_shared<Topology>(start_of_run + result_.warmup));
}

ScenarioRun::~ScenarioRun() = default;

/// Checks before the run that its results would not replace the scenario that was read.
void ScenarioRun::check_scenario_stays(const std::string& folder) const {
    const std::string path = folder + "/scenario.toml";
    if (!is_kept_input(path)) return;
    std::istringstream document(to_toml(document_in(folder, scenario_)));
    if (!replaces_input(path, document)) return;
    throw RunError(path +
                   ": this file is an input of the command, and the results would replace it; "
                   "expected a different folder for the results (--out)");
}

void ScenarioRun::write_to(const std::string& folder) {
    result_.folder = folder;
    make_folder(folder);
    check_scenario_stays(folder);
    traces_ = trace_files(scenario_, folder);
    for (const TraceFile& trace : traces_) session_->network().add_sink(trace.sink);
    if (!traces_.empty()) result_.trace = traces_.front().path;
}

RunResult ScenarioRun::finish() {
    Network& network = session_->network();
    if (fingerprint_) result_.fingerprint = fingerprint_->text();
    network.finish();

    result_.simulated = network.now() - start_of_run;
    result_.metrics = network.metrics();
    result_.airtime = airtime_values(network.airtime(), result_.metrics);
    if (topology_)
        result_.topology = std::make_shared<const TopologyValues>(topology_->values(network.now()));
    if (planners_) result_.searches = planners_->searches() - searched_;
    result_.events = network.events();
    result_.network = session_->shared_network();
    result_.interference_left_out = network.interference_left_out();
    result_.timeline = timeline_;
    result_.wall_s = std::chrono::duration<double>(WallClock::now() - begun_).count();
    if (result_.folder.empty()) return std::move(result_);
    try {
        write_results();
    } catch (const RunError& error) {
        result_.folder.clear();
        throw UnwrittenResults(error, std::move(result_));
    }
    return std::move(result_);
}

void ScenarioRun::write_results() {
    const std::string& folder = result_.folder;
    PartFile document(folder + "/scenario.toml"), summary(folder + "/summary.json");
    document.write(to_toml(document_in(folder, scenario_)));
    write_summary(scenario_, result_, summary);
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
