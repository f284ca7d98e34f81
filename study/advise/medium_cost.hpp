// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "scenario/scenario.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <variant>
#include <vector>

namespace rovernet {

/// Record of what the medium was asked in one run of a scenario, and of what it had to know for
/// that.
struct MediumRecord {
    /// A node puts a frame on air.
    struct OnAir {};
    /// Step of a node: it begins a leg, is switched on or off, or sends.
    struct Event {
        Time time;
        NodeId node;
        std::variant<Leg, bool, OnAir> what;
    };
    std::vector<Event> events;
    std::uint64_t frames = 0;         ///< put on air, those of access control included ...
    std::uint64_t transmissions = 0;  ///< ... and those of messages
    std::uint64_t receivers = 0;      ///< receivers of all frames, lost or not
};

/// Records one run of a scenario, the first 200,000 frames of it at most.
/// @param stopped  asked now and then; true ends the recording, which is then of what was seen
MediumRecord record_medium(const Scenario& scenario, const std::function<bool()>& stopped);

/// A medium with a scenario's robots and models, to answer a record's questions.
class MediumReplay {
  public:
    explicit MediumReplay(const Scenario& scenario);

    /// Cost of answering.
    struct Answers {
        std::uint64_t frames = 0, receivers = 0;
        double cpu_s = 0;  ///< [s] of this thread, the making of the medium left out
    };
    /// Answers a record from its beginning, as in the run: caches of pairs at rest begin empty.
    /// @param most_frames  frames to answer, at most
    /// @param most_s       CPU time to spend [s], at most, about
    Answers answer(const MediumRecord& record, std::uint64_t most_frames, double most_s) const;

  private:
    NetworkSettings settings_;
    std::unique_ptr<Network> network_;  // before the run
};

/// Cost of propagation models: CPU time of the medium per frame, which looks for the frame's
/// receivers.
struct MediumCost {
    double median_s = 0, low_s = 0, high_s = 0;  ///< [s] per frame, of the turns
    double receivers = 0;  ///< found per frame: a model of more reach has more to answer
};

/// Costs of several models, measured on one record in turns.
struct MediumCosts {
    std::vector<MediumCost> models;  ///< costs, one for each scenario; none if nobody sends
    std::uint64_t frames = 0;        ///< frames of the record, which each pass answers
    double frames_per_transmission = 1;
    double turn_s = 0;  ///< [s] of CPU time that a turn measures at least
    int turns = 0;
};

/// Duration of the measurement.
struct CostTurns {
    int turns = 5;
    double total_s = 3;  ///< [s] CPU time of all turns together, in turns of 0.05 s to 0.2 s
};

/// Measures what each scenario's model costs on the frames of `record`: 5 turns, and in each of
/// them all models one after the other, so that a machine that slows down slows them all down.
/// Times are this machine's, now: two measurements differ.
/// @param scenarios  with the same robots
/// @param stopped    asked now and then; true ends the measurement, without costs
MediumCosts measure_medium(const MediumRecord& record, const std::vector<Scenario>& scenarios,
                           const CostTurns& turns, const std::function<bool()>& stopped);

}  // namespace rovernet
