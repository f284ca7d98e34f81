// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/recorded_scenario.hpp"
#include "network/network.hpp"
#include "sim/message.hpp"
#include "study/deliveries.hpp"
#include "traces/metric_values.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rovernet {

/// What happened when a recorded day was played under some radio.
struct PlayedDay {
    MetricValues metrics;              ///< without the warm-up of the recorded run
    std::vector<Delivery> deliveries;  ///< all of the day, in order
};

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
class RecordedDay {
  public:
    /// @param path  recorded trace
    /// @throws InputError if it is none, or holds no scenario
    explicit RecordedDay(const std::string& path);

    /// Names of the robots by NodeId.
    const std::vector<std::string>& robots() const { return run_.robots; }
    /// What is broken or missing in the trace, as sentences.
    const std::vector<std::string>& damage() const { return damage_; }
    /// The day as it was recorded.
    const PlayedDay& recorded() const { return recorded_; }
    /// Plays the day under the radio of its scenario with these assignments "path=value" over it.
    /// @param progress  told the share that is done, 0 ... 1; false stops it
    /// @throws InputError, RunError, Interrupted
    PlayedDay play(const std::vector<std::string>& set,
                   const std::function<bool(double)>& progress = {}) const;

  private:
    struct Said {
        Time time;
        Message message;
    };
    struct Turned {
        Time time;
        NodeId node;
        bool on;
    };
    struct Reading;
    void add_robots(Network& network, const Scenario& scenario) const;
    void schedule(Network& network) const;

    RecordedRun run_;
    std::unique_ptr<ReplayedScenario> scenario_;
    std::vector<std::vector<Leg>> legs_;  // by NodeId
    std::vector<Said> said_;
    std::vector<Turned> turned_;
    PlayedDay recorded_;
    std::vector<std::string> damage_;
};

}  // namespace rovernet
