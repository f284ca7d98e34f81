// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/run.hpp"
#include "experiment/session.hpp"
#include "live/input_log.hpp"
#include "mobility/kept_planners.hpp"
#include "scenario/scenario.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {

/// Run of a scenario whose robots a program in this process drives, step by step: what Lockstep
/// does for one controller, without lines. The same commands give the same run through both.
///
///   SteppedRun run(scenario, {.step = 100ms});
///   while (!run.is_done()) {
///       run.command(0, DriveCommand{{0.5}, {0.1}});
///       run.step(256, [] { return true; });
///       for (const HeardMessage& message : run.heard()) use(message);
///   }
///   const RunResult result = run.finish();
class SteppedRun {
  public:
    struct Settings {
        /// Names of the robots that it drives, in the order of their rows; none: all robots.
        std::optional<std::vector<std::string>> robots = {};
        /// Simulated time of a step [ns], >= shortest_step.
        Duration step = std::chrono::milliseconds{100};
        /// Folder for results and inputs, as `rovernet live` writes them; none: nothing is written.
        std::optional<std::string> folder = {};
        /// Name of the program in the log of inputs.
        std::string client = "program";
        /// Adds sinks to the network of the run, and of the run after each reset.
        std::function<void(Network&)> prepare = {};
    };

    /// Begins the run.
    /// @throws std::invalid_argument for a setting; InputError, RunError as ScenarioRun
    SteppedRun(Scenario scenario, Settings settings);
    ~SteppedRun();

    /// Begins anew. @param seed  none: the same again. @throws InputError, RunError
    void reset(std::optional<std::uint64_t> seed = {});

    // Commands, which are carried out as the next step begins: by robot, its last movement before
    // its messages. @throws std::invalid_argument for a number out of its range

    /// @param row  of the robot
    void command(std::size_t row, RobotCommand command);
    /// Drives each robot by its row of `velocities`.
    /// @param velocities  speed [m/s] and turn rate [rad/s] of each robot, by row; a robot whose
    ///                    two are not a number goes on as it was told
    /// @param timeout     as that of DriveCommand
    void drive(std::span<const double> velocities, std::optional<Duration> timeout = {});

    /// Carries out what was commanded and runs for a step, or to the scenario's end.
    /// @param most_events  that are served between two calls of `go_on`
    /// @param go_on        asked now and then; false ends the step where it is
    /// @return whether the step was not cut
    /// @throws RunError if the run is at its end; InputError, RunError as Session::step()
    bool step(std::uint64_t most_events, const std::function<bool()>& go_on);
    /// Messages that its robots heard since this was asked last, in order of time, then of robot.
    std::vector<HeardMessage> heard() { return session().heard(client_); }

    /// Robots that it drives, by row.
    const std::vector<NodeId>& robots() const { return robots_; }
    /// x [m], y [m] and heading [rad] of each robot at the end of the last step, one behind the
    /// other; it stays at its place.
    std::span<const double> poses() const { return poses_; }
    /// The scenario is at its end.
    bool is_done() const { return session().network().now() >= session().end(); }
    /// Whether finish() was called, or the last reset failed: only reset() may be called then.
    bool is_over() const { return !run_; }
    const Scenario& scenario() const { return scenario_; }
    Duration step_length() const { return settings_.step; }
    std::string fingerprint() const { return run().fingerprint().text(); }
    /// @throws RunError if it is over
    Session& session() const { return run().session(); }

    /// Lets the robots go, which stop, and ends the run where it is. @throws RunError
    RunResult finish();

  private:
    void begin();
    void carry_out();
    void look();
    ScenarioRun& run() const;
    std::string name(std::size_t row) const { return session().network().name(robots_[row]); }

    Scenario scenario_;
    Settings settings_;
    KeptPlanners kept_;
    std::unique_ptr<ScenarioRun> run_;
    std::optional<InputLog> log_;
    ClientId client_ = 0;
    std::vector<NodeId> robots_;
    std::vector<std::size_t> ascending_;  // rows, by robot
    // Last movement that was commanded, by row: for the next step, and those that are carried out.
    std::vector<std::optional<RobotCommand>> movements_, carried_;
    std::vector<std::pair<std::size_t, SendCommand>> messages_;  // with their rows
    std::vector<double> poses_;
    std::uint64_t steps_ = 0;
};

}  // namespace rovernet
