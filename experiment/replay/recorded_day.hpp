// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/recorded_scenario.hpp"
#include "experiment/replay/day_log.hpp"
#include "network/network.hpp"
#include "sim/sink.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rovernet {

/// Deliveries in only one of two runs of the same messages, and number of deliveries in both.
struct DeliveryDifference {
    /// Deliveries in only the second (gained) or only the first run (lost), by message, then by
    /// receiver.
    std::vector<Delivery> gained, lost;
    std::uint64_t same = 0;  ///< number of deliveries in both runs
};
/// Difference between the deliveries in two runs, each in any order.
DeliveryDifference difference_of(std::vector<Delivery> before, std::vector<Delivery> after);

/// Difference between the deliveries in two runs of the same messages, counted by receiving robot.
struct DeliveryChange {
    /// Number of deliveries in only the second (gained) or only the first run (lost), by receiver
    /// (NodeId).
    std::vector<std::uint64_t> gained, lost;

    std::uint64_t all_gained() const;
    std::uint64_t all_lost() const;
};
/// Difference between the deliveries in two runs. @param robots  number of robots
DeliveryChange change_of(const PlayedDay& before, const PlayedDay& after, std::size_t robots);

/// Recorded run (movements and messages) that can be simulated again with other radio models.
/// Robots move, send and are switched on and off as recorded. Robots do not react to messages
/// received in the new simulation. To simulate reactions, run the scenario with other settings
/// instead.
///
///     const RecordedDay day("runs/rescue-s7/trace.mcap");
///     const PlayedDay other = day.play({"propagation.model=friis"});
///     change_of(day.recorded(), other, day.robots().size()).all_gained();
class RecordedDay {
  public:
    /// @param path  recorded trace
    /// @throws InputError if the file is no recorded trace, or has no scenario
    explicit RecordedDay(const std::string& path);
    /// Makes a recorded run from a trace that has already been read, in any format.
    /// @param run   scenario, and names of robots by NodeId
    /// @param path  path of the trace, for errors, and to find files that are not attached
    /// @param log   actions of the robots, and outcome of the run, from the trace
    /// @throws InputError if the scenario cannot be read
    RecordedDay(RecordedRun run, const std::string& path, DayLog log);

    const RecordedRun& run() const { return run_; }
    /// Legs (pieces of movement) of each robot, by NodeId.
    const std::vector<std::vector<Leg>>& legs() const { return log_.legs; }
    /// Names of the robots by NodeId.
    const std::vector<std::string>& robots() const { return run_.robots; }
    /// Sentences about broken or missing parts of the trace.
    const std::vector<std::string>& notices() const { return log_.notices; }
    /// Recorded outcome of the run: metrics and deliveries.
    const PlayedDay& recorded() const { return log_.recorded; }
    /// Simulates the recorded movements and messages with the radio models of the scenario,
    /// overridden by assignments "path=value". If the routing protocol only supports broadcasts, a
    /// message for one robot is flooded to all robots, but is delivered only at its destination.
    /// @param progress  called with the finished share, 0 ... 1; returning false stops the
    /// simulation
    /// @throws InputError, RunError, Interrupted
    PlayedDay play(const std::vector<std::string>& set,
                   const std::function<bool(double)>& progress = {}) const {
        return play(set, progress, {});
    }
    /// Simulates like play(), and writes the new run to a recorded trace. The scenario in this
    /// trace includes the assignments `set`.
    /// @param path  path of the new trace
    /// @throws InputError, RunError, Interrupted
    PlayedDay record(const std::string& path, const std::vector<std::string>& set,
                     const std::function<bool(double)>& progress = {}) const;

    /// Warning, as a sentence, if at least a tenth of the messages start at the same instant and
    /// therefore collide; empty if fewer messages do. The access model is the one of the scenario,
    /// after the assignments `set`.
    /// @throws InputError
    std::string starts_together(const std::vector<std::string>& set) const;
    /// Warning, as a sentence, if the farthest reception in the trace is beyond the range of the
    /// radio; empty if it is in range, or if the trace has no receptions. The radio is the one of
    /// the scenario, after the assignments `set`.
    /// @throws InputError
    std::string hears_farther(const std::vector<std::string>& set) const;

  private:
    PlayedDay play(const std::vector<std::string>& set, const std::function<bool(double)>& progress,
                   const std::vector<Sink>& sinks) const;
    void add_robots(Network& network, const Scenario& scenario) const;
    void schedule(Network& network) const;

    RecordedRun run_;
    std::unique_ptr<ReplayedScenario> scenario_;
    DayLog log_;
};

}  // namespace rovernet
