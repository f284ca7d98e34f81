// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/output.hpp"
#include "experiment/playing.hpp"
#include "experiment/timeline.hpp"
#include "models/propagation/rays.hpp"
#include "network/network.hpp"
#include "scenario/scenario.hpp"
#include "scenario/document/value.hpp"
#include "traces/fingerprint.hpp"
#include "traces/metrics.hpp"
#include "traces/topology.hpp"

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {

class KeptPlanners;
class ScenarioRun;
class Session;
struct TraceFile;

struct RunOptions {
    std::optional<std::string> folder;  ///< folder for the results; run_folder() if not given
    std::optional<double> speed;        ///< simulated per real time [-]; none: unpaced
    /// Told the share that is done, 0 ... 1, now and then; false stops the run.
    std::function<bool(double)> progress = {};
    /// Runs the session in place of Session::run(), by programs outside, say; it may end early.
    /// False: the run was stopped.
    std::function<bool(ScenarioRun&)> drive = {};
};

/// The run was stopped from outside; none of its files was left.
class Interrupted : public std::exception {
  public:
    const char* what() const noexcept override { return "interrupted"; }
};

struct RunResult {
    std::string folder;                ///< empty: nothing was written
    std::optional<std::string> trace;  ///< path of the ns-2 trace, or else of the recorded one
    MetricValues metrics;
    std::string fingerprint;
    Table parts;  ///< see append_parts()
    std::uint64_t events = 0;
    Duration simulated{0};  ///< that it ran for: the scenario's, unless it ended early
    std::optional<Db> interference_left_out;  ///< see Network
    double wall_s = 0;                        ///< [s] of real time
    std::string started;                      ///< UTC, ISO 8601
    std::shared_ptr<const Timeline> timeline;
    std::shared_ptr<const Network> network;  ///< network as the run left it
};

/// Run of a scenario whose session somebody else takes through it; run_scenario() makes one, too.
///
///   ScenarioRun run(scenario);
///   run.write_to("runs/mine");           // or not: then nothing is written
///   run.session().step(start_of_run + 10s);
///   RunResult result = run.finish();
class ScenarioRun {
  public:
    /// Makes the network. @throws InputError for what only shows on the map
    /// @param scenario  which has to live as long
    /// @param kept      planners of its scene from earlier runs, which are kept there; may be null
    explicit ScenarioRun(const Scenario& scenario, KeptPlanners* kept = nullptr);
    ~ScenarioRun();
    ScenarioRun(const ScenarioRun&) = delete;  // sinks refer to it
    ScenarioRun& operator=(const ScenarioRun&) = delete;

    /// Begins the traces that the scenario asks for, in the folder that gets the results; before
    /// the session's first step. @throws RunError if that cannot be written
    void write_to(const std::string& folder);
    Session& session() { return *session_; }
    /// Fingerprint of the run so far.
    const Fingerprint& fingerprint() const { return *fingerprint_; }
    /// Adds a table of its own to summary.json.
    void add_part(std::string name, Table part) { result_.parts.set(std::move(name), part); }
    /// Ends the run where it is, and writes the results if they have a folder. Once. @throws
    /// RunError
    RunResult finish();

  private:
    void write_results();

    const Scenario& scenario_;
    std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
    RunResult result_;  // as far as it is known
    Duration warmup_{0};
    std::unique_ptr<Session> session_;
    std::shared_ptr<Fingerprint> fingerprint_ = std::make_shared<Fingerprint>();
    std::shared_ptr<Timeline> timeline_;
    std::shared_ptr<Topology> topology_;  // null: not measured
    std::vector<TraceFile> traces_;
};

/// Runs a scenario and writes summary.json, scenario.toml and the trace that it asks for into its
/// folder, each whole or not at all.
/// @throws InputError, RunError, Interrupted
RunResult run_scenario(const Scenario& scenario, const RunOptions& options);

/// The metrics as the tables of summary.json and of `rovernet trace stats --json` show them.
void append_metrics(Table& table, const MetricValues& metrics);

/// Metrics that [metrics] asks for beside the totals, as tables by name: "flows", "robots",
/// "topology".
/// @param measured  what the run measured, without its warm-up
/// @param topology  null: not measured
void append_parts(Table& table, const Scenario& scenario, const Network& network,
                  const MetricValues& metrics, Duration measured, Topology* topology);
/// Adds the sink that measures the topology to the network, if [metrics] asks for it; else null.
std::shared_ptr<Topology> add_topology(Network& network, const Scenario& scenario, Duration warmup);

/// Document that `run --json` prints: the results. Only summary.json has the times of the run and
/// what depends on the machine. Its timeline is empty: write_summary() renders that.
Table run_summary(const Scenario& scenario, const RunResult& result);
/// Writes such a summary as JSON, piece by piece, with the timeline.
void write_summary(const Table& summary, const Timeline& timeline, const Write& write);

/// Time of day now, as "2025-06-30T23:59:59Z".
std::string utc_now();
/// Name of this machine.
std::string host_name();

/// The robot of that name. @throws std::invalid_argument, naming some that there are
NodeId robot_named(const Network& network, const std::string& name);

/// The scenario as far as robots and links depend on it: without its traffic, unless a robot reacts
/// to messages.
Scenario without_idle_traffic(const Scenario& scenario);

/// A network whose robots and links are as the scenario's at `at`.
std::unique_ptr<Network> network_at(const Scenario& scenario, Time at, const TellTime& tell = {});

/// The link from A to B at a time.
struct LinkReport {
    std::string from, to, model;
    Time at;
    double distance_m;
    std::vector<Wall> walls;
    std::vector<std::string> materials;  ///< materials of the walls, one each
    std::vector<Db> wall_losses;         ///< loss of each wall; part of the path loss
    double wall_m;
    std::size_t ceilings;  ///< ceilings between the antennas, in a scene of several storeys
    Db ceiling_loss;       ///< loss of all of them; part of the path loss
    std::size_t floors;    ///< floors between the antennas: the ceilings, or as the model counts
    Db floor_loss;         ///< loss of all of them; part of the path loss
    Radio sender, receiver;
    Db path_loss;                         ///< all of it: walls and shadowing are in it
    std::optional<Db> shadowing;          ///< part of the path loss, if there is some
    Db sender_pattern, receiver_pattern;  ///< gain of each antenna towards the other, <= 0
    Dbm received;
    Db margin;
    bool up;                          ///< the link is up, and both robots are on
    std::string why_down;             ///< "B is off", say; empty if it is up
    std::optional<Rays::Paths> rays;  ///< paths of the link, if its model is rays
};

/// Runs the scenario until `at`, then looks at one link. Only the two robots, and those that their
/// movements depend on, move, unless some robot reacts to what others do.
/// @throws std::invalid_argument if there is no such robot or both are one
LinkReport report_link(const Scenario& scenario, const std::string& from, const std::string& to,
                       Time at, const TellTime& tell = {});

}  // namespace rovernet
