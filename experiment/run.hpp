// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "sim/error.hpp"
#include "sim/router.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"
#include "traces/metric_values.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {

class Fingerprint;
class KeptPlanners;
class Network;
class Planners;
class ScenarioFile;
class ScenarioRun;
class Session;
class Timeline;
class Topology;
struct Scenario;
struct TopologyValues;
struct TraceFile;

/// Options of run_scenario().
struct RunOptions {
    std::optional<std::string> folder;  ///< folder for the results of the run; none: run_folder()
    std::optional<double> speed;        ///< ratio of simulated time to real time [-]; none: as fast
                                        ///< as possible
    /// Callback, called repeatedly with the finished share, 0 ... 1; returning false stops the run.
    std::function<bool(double)> progress = {};
    /// Function that runs the session in place of Session::run(), to serve external programs. The
    /// function may end the run early. It returns false if the run was stopped.
    std::function<bool(ScenarioRun&)> drive = {};
};

/// Exception thrown when the user stops a run. The files of the run are removed.
class Interrupted : public std::exception {
  public:
    const char* what() const noexcept override { return "interrupted"; }
};

/// Results of a run: metrics, files and costs, and the network at its end.
struct RunResult {
    std::string folder;                ///< folder of the results; empty: nothing was written
    std::optional<std::string> trace;  ///< path of the ns-2 trace, or else of the recorded trace
    MetricValues metrics;
    AirtimeValues airtime;
    std::string fingerprint;
    std::shared_ptr<const TopologyValues> topology;  ///< topology metrics; null: not measured
    Table added;  ///< tables that were added to the results, see ScenarioRun::add_part()
    std::uint64_t events = 0;
    Duration warmup{0};  ///< warm-up of the run, which is not measured [ns]
    /// Simulated duration of the run [ns]; shorter than the scenario's duration if it ended early.
    Duration simulated{0};
    std::uint64_t searches = 0;  ///< number of path searches by cached planners (KeptPlanners); 0
                                 ///< without a cache
    std::optional<Db> interference_left_out;  ///< bound on the SINR error by neglected frames [dB]
    double wall_s = 0;                        ///< duration of the run in real time [s]
    std::string started;                      ///< start of the run in real time, UTC, ISO 8601
    std::shared_ptr<const Timeline> timeline;
    std::shared_ptr<const Network> network;  ///< network at the end of the run

    /// Duration of the measured part of the run [ns]: the run without its warm-up.
    Duration measured() const { return std::max(simulated - warmup, Duration{0}); }
};

/// Error of a run whose results cannot be written. `result` has the results, without a folder.
struct UnwrittenResults : RunError {
    UnwrittenResults(const RunError& error, RunResult run)
        : RunError(error), result(std::move(run)) {}
    RunResult result;
};

/// Choice of the results that a run collects, in addition to the sinks that its caller adds.
enum class Observed {
    everything,    ///< metrics (no warm-up), requested topology, fingerprint, timeline
    measurements,  ///< everything except the timeline
    metrics,       ///< metrics of the network only, including the warm-up
    nothing        ///< no results, not even metrics
};

/// Run of a scenario whose session the caller advances. This class sets up the run's settings,
/// planners, warm-up and sinks, and gathers its results. run_scenario(), measure(), verify_replay()
/// and flood_bench() use it.
///
///   ScenarioRun run(scenario);
///   run.write_to("runs/mine");           // optional: without it nothing is written
///   run.session().step(start_of_run + 10s);
///   RunResult result = run.finish();
class ScenarioRun {
  public:
    /// Makes the network of the run.
    /// @throws InputError for errors found with the map, such as a robot in a wall
    /// @param scenario  must outlive the run
    /// @param kept      cache of path planners, shared by runs in one scene; may be null
    /// @param router    makes the routing protocol of each network, in place of the scenario's
    ///                  protocol; may be empty
    explicit ScenarioRun(const Scenario& scenario, KeptPlanners* kept = nullptr,
                         Observed observed = Observed::everything,
                         const std::function<Router()>& router = {});
    ~ScenarioRun();
    ScenarioRun(const ScenarioRun&) = delete;  // sinks refer to this object
    ScenarioRun& operator=(const ScenarioRun&) = delete;

    /// Sets the folder of the results, and opens the traces of the scenario in this folder. Must be
    /// called before the session's first step. @throws RunError if the folder or a trace cannot be
    /// written
    void write_to(const std::string& folder);
    Session& session() { return *session_; }
    /// Fingerprint (hash) of the run's records so far.
    const Fingerprint& fingerprint() const { return *fingerprint_; }
    /// Adds a table to the run's results (summary.json), under the key `name`.
    void add_part(std::string name, Table part) { result_.added.set(std::move(name), part); }
    /// Ends the run at the current time, and writes the results if a folder was given. Must be
    /// called once. @throws RunError
    RunResult finish();

  private:
    void observe(Observed observed);
    void check_scenario_stays(const std::string& folder) const;
    void write_results();

    const Scenario& scenario_;
    std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
    RunResult result_;  // result of the run so far
    std::unique_ptr<Session> session_;
    std::shared_ptr<Planners> planners_;        // cached path planners; null: no cache
    std::uint64_t searched_ = 0;                // number of path searches before the run
    std::shared_ptr<Fingerprint> fingerprint_;  // sink of the fingerprint; null: not observed
    std::shared_ptr<Timeline> timeline_;        // sink of the timeline; null: not observed
    std::shared_ptr<Topology> topology_;        // sink of the topology; null: not measured
    std::vector<TraceFile> traces_;
};

/// Runs a scenario and writes summary.json, scenario.toml and its traces into the folder of the
/// run, each completely or not at all.
/// @throws InputError, RunError, Interrupted; UnwrittenResults if the run is over
RunResult run_scenario(const Scenario& scenario, const RunOptions& options);
/// Runs the scenario of a file, overridden by `settings` (values by path, as in the option --set).
RunResult run_scenario(const ScenarioFile& file, const Table& settings, const RunOptions& options);

}  // namespace rovernet
