// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/run.hpp"
#include "experiment/session.hpp"
#include "live/input_log.hpp"
#include "live/lockstep/controllers.hpp"
#include "mobility/kept_planners.hpp"
#include "scenario/scenario.hpp"
#include "traces/fingerprint.hpp"

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

/// Run of a scenario whose robots are driven step by step by a program in this process, which is
/// its only controller. A program that sends the same commands by the lock-step protocol (Lockstep)
/// gets the same run.
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
        /// Names of the driven robots, in the order of poses(); none: all robots.
        std::optional<std::vector<std::string>> robots = {};
        /// Simulated time of a step [ns], >= shortest_step.
        Duration step = std::chrono::milliseconds{100};
        /// Folder for results and input log, as written by `rovernet live`; none: nothing is
        /// written.
        std::optional<std::string> folder = {};
        /// Name of the program in the input log.
        std::string client = "program";
        /// Function that adds sinks (observers of records) to the network, called for the first run
        /// and after each reset.
        std::function<void(Network&)> prepare = {};
    };

    /// Starts the run.
    /// @throws std::invalid_argument for a wrong setting; InputError, RunError as the constructor
    /// of ScenarioRun
    SteppedRun(Scenario scenario, Settings settings);
    ~SteppedRun();

    /// Starts the run again. @param seed  none: the same seed. @throws InputError, RunError
    void reset(std::optional<std::uint64_t> seed = {});

    // Commands are executed at the start of the next step, robot by robot: first the robot's last
    // movement command, then its messages. @throws std::invalid_argument for a number out of range

    /// Adds a command for the next step. @param row  index of the robot in robots()
    void command(std::size_t row, RobotCommand command);
    /// Drives each robot by its pair of numbers in `velocities`.
    /// @param velocities  speed [m/s] and turn rate [rad/s] of each robot, in the order of
    /// robots(); two NaNs leave the robot's last command unchanged
    /// @param timeout     see DriveCommand
    void drive(std::span<const double> velocities, std::optional<Duration> timeout = {});

    /// Executes the commands of this step, and runs for one step or to the end of the scenario.
    /// @param most_events  events processed between two calls of `go_on`
    /// @param go_on        called repeatedly during the step; returning false interrupts the step
    /// @return whether the step was completed
    /// @throws RunError if the scenario has ended; InputError, RunError as Session::step()
    bool step(std::uint64_t most_events, const std::function<bool()>& go_on);
    /// Fetches the messages that the driven robots received since the last call, in order of time,
    /// then of robot.
    std::vector<HeardMessage> heard() { return session().heard(controller().client); }

    /// Driven robots, in the order of poses().
    const std::vector<NodeId>& robots() const { return robots_; }
    /// x [m], y [m] and heading [rad] of each robot at the end of the last step, one robot after
    /// the other. The array keeps its address.
    std::span<const double> poses() const { return poses_; }
    /// Whether the scenario has reached its end.
    bool is_done() const { return session().network().now() >= session().end(); }
    /// Whether finish() was called, or the last reset failed: only reset() may be called then.
    bool is_over() const { return !run_; }
    const Scenario& scenario() const { return scenario_; }
    Duration step_length() const { return settings_.step; }
    std::string fingerprint() const { return run().fingerprint().text(); }
    /// Session of the run. @throws RunError if the run is over
    Session& session() const { return run().session(); }

    /// Releases the robots, which stop, and ends the run at the current time. @throws RunError
    RunResult finish();

  private:
    void begin();
    void fill_request();
    void look();
    Controller& controller() { return *controllers_.begin(); }
    ScenarioRun& run() const;
    std::string name(std::size_t row) const { return session().network().name(robots_[row]); }

    Scenario scenario_;
    Settings settings_;
    KeptPlanners kept_;
    std::unique_ptr<ScenarioRun> run_;
    std::optional<InputLog> log_;
    Controllers controllers_;  // the program as only controller
    std::vector<NodeId> robots_;
    std::vector<std::optional<RobotCommand>> movements_;  // last movement of each robot
    std::vector<std::pair<NodeId, RobotCommand>> messages_;
    StepRequest request_;  // request of the current step
    std::vector<double> poses_;
};

}  // namespace rovernet
