// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "scenario/scenario.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <variant>
#include <vector>

namespace rovernet {

/// Recording of all calls to the simulated medium (class Medium) in one run of a scenario: legs,
/// switching and frames. The recording can be replayed.
struct MediumRecord {
    /// Type of an event in which a node transmits a frame.
    struct OnAir {};
    /// Event of a node: begin of a leg (piece of movement), switching on or off, or transmission.
    struct Event {
        Time time;
        NodeId node;
        std::variant<Leg, bool, OnAir> what;
    };
    std::vector<Event> events;
    /// Number of frames on air, including control frames (RTS, CTS, ACK).
    std::uint64_t frames = 0;
    std::uint64_t transmissions = 0;  ///< number of frames that carry messages
    /// Number of receivers found, summed over all frames. Receivers that lose the frame are
    /// included.
    std::uint64_t receivers = 0;
};

/// Records one run of a scenario: at most the first 200,000 frames, and about the first 2,000,000
/// events.
/// @param stopped  called repeatedly; returning true ends the recording early
MediumRecord record_medium(const Scenario& scenario, const std::function<bool()>& stopped);

/// Simulated medium with the robots and models of a scenario, to replay a recording of calls.
class MediumReplay {
  public:
    explicit MediumReplay(const Scenario& scenario);

    /// Result of a replay: number of frames, number of receivers found, and CPU time.
    struct Answers {
        std::uint64_t frames = 0, receivers = 0;
        double cpu_s = 0;  ///< CPU time of the replay in this thread [s], without building the
                           ///< medium
    };
    /// Replays a recording from its beginning, with empty caches of the medium, as at the start of
    /// a run.
    /// @param most_frames  largest number of frames
    /// @param most_s       approximate limit of CPU time [s]
    Answers answer(const MediumRecord& record, std::uint64_t most_frames, double most_s) const;

  private:
    NetworkSettings settings_;
    std::unique_ptr<Network> network_;  // network before the start of the run
};

/// Cost of a propagation model: CPU time that the medium needs to find the receivers of a frame.
struct MediumCost {
    /// CPU time per frame [s]: median, lowest and highest value over the measurement turns.
    double median_s = 0, low_s = 0, high_s = 0;
    double receivers = 0;  ///< mean number of receivers per frame; a longer range gives more
                           ///< receivers and more work
};

/// Costs of several propagation models, measured on one recording, in turns.
struct MediumCosts {
    std::vector<MediumCost> models;  ///< cost of the model of each scenario; empty if no robot
                                     ///< sends
    std::uint64_t frames = 0;        ///< number of frames in each pass over the recording
    double frames_per_transmission = 1;
    double turn_s = 0;  ///< least CPU time of each model in a measurement turn [s]
    int turns = 0;
};

/// Number of turns and duration of a cost measurement.
struct CostTurns {
    int turns = 5;
    double total_s = 3;  ///< CPU time of all turns [s]; 0.05 to 0.2 s for each model and turn
};

/// Measures the cost of each scenario's propagation model on the frames of `record`. Each turn
/// measures all models one after the other, so that a slowdown of the machine affects all models
/// equally. Results differ between machines and between measurements.
/// @param scenarios  scenarios with the same robots
/// @param stopped    called repeatedly; returning true ends the measurement, without costs
MediumCosts measure_medium(const MediumRecord& record, const std::vector<Scenario>& scenarios,
                           const CostTurns& turns, const std::function<bool()>& stopped);

}  // namespace rovernet
