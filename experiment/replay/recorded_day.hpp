// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/recorded_scenario.hpp"
#include "network/network.hpp"
#include "experiment/replay/day_log.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rovernet {

/// Deliveries that one day has and another has not, by the robot that got them or did not.
struct DeliveryChange {
    std::vector<std::uint64_t> gained, lost;  ///< by NodeId

    std::uint64_t all_gained() const;
    std::uint64_t all_lost() const;
};
/// @param robots  number of robots
DeliveryChange change_of(const PlayedDay& before, const PlayedDay& after, std::size_t robots);

/// One recorded day, to be played under another radio: robots move, speak and are switched as they
/// did when it was recorded. What they would have decided otherwise is not decided anew: for that,
/// run the scenario with other settings.
///
///     const RecordedDay day("runs/rescue-s7/trace.mcap");
///     const PlayedDay other = day.play({"propagation.model=friis"});
///     change_of(day.recorded(), other, day.robots().size()).all_gained();
class RecordedDay {
  public:
    /// @param path  recorded trace
    /// @throws InputError if it is none, or holds no scenario
    explicit RecordedDay(const std::string& path);
    /// Makes a day of any other trace.
    /// @param run   its scenario, and the names of its robots by NodeId
    /// @param path  of the trace, for errors
    /// @throws InputError if the scenario cannot be read
    RecordedDay(RecordedRun run, const std::string& path, DayLog log);

    /// Names of the robots by NodeId.
    const std::vector<std::string>& robots() const { return run_.robots; }
    /// What is broken or missing in the trace, as sentences.
    const std::vector<std::string>& notices() const { return log_.notices; }
    /// The day as it was recorded.
    const PlayedDay& recorded() const { return log_.recorded; }
    /// Plays the day under the radio of its scenario with these assignments "path=value" over it.
    /// A protocol that brings messages to everyone only also brings those for one robot: to
    /// everyone, and they count as delivered at that robot.
    /// @param progress  told the share that is done, 0 ... 1; false stops it
    /// @throws InputError, RunError, Interrupted
    PlayedDay play(const std::vector<std::string>& set,
                   const std::function<bool(double)>& progress = {}) const;

  private:
    void add_robots(Network& network, const Scenario& scenario) const;
    void schedule(Network& network) const;

    RecordedRun run_;
    std::unique_ptr<ReplayedScenario> scenario_;
    DayLog log_;
};

}  // namespace rovernet
