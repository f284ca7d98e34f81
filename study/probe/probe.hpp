// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"
#include "sim/time.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

// What becomes of a scenario's links and messages under each of its perturbations(): a result that
// changes with them is one of the drawing or of the exact place, and not of the robots.

namespace rovernet {

/// Bounds of a probe's work.
struct ProbeSize {
    std::uint32_t times = 20;          ///< times of the run at which links are looked at
    std::size_t links = 1000;          ///< at most
    std::uint64_t events = 1'000'000;  ///< events of the run whose messages are compared; 0: none
    std::size_t messages = 100;        ///< changes of messages kept for each perturbation, at most
};

/// Effect of one perturbation on a link. If it displaces an end, this is the displacement that
/// changes the loss most.
struct LinkEffect {
    std::string link;          ///< its ends, and when
    std::string perturbation;  ///< such as "resolution x2", or "1 cm: A to the east"
    double distance = 0;       ///< between the antennas [m]
    double budget = 0;         ///< loss that the link bears [dB]
    double before = 0;         ///< path loss as given [dB]
    double after = 0;          ///< path loss under the perturbation [dB]
    double moved = 0;          ///< displacement of one end [m]; 0: none

    double change() const { return after - before; }  ///< [dB]
    bool was_up() const { return before <= budget; }
    bool is_up() const { return after <= budget; }
    bool flips() const { return was_up() != is_up(); }
    /// Change of the loss over the displacement of the end [dB/mm]; 0 without one.
    double steepness() const;
    /// The loss changes by more than 0.5 dB per mm.
    bool is_cliff() const { return steepness() > cliff; }

    static constexpr double cliff = 0.5;  // [dB/mm]
};

/// Robot that got a message in one of two runs.
struct MessageEffect {
    std::string from, at;  ///< robots
    std::uint32_t number;  ///< of the message among those of `from`, from 0
    Time sent;
    std::string perturbation;
    bool gained;  ///< it got the message under the perturbation only; otherwise as given only
};

/// A perturbation, over all links and messages.
struct PerturbationEffect {
    std::string name;
    std::string nothing;       ///< why nothing was changed; empty: it was
    std::size_t changed = 0;   ///< links whose loss changes by more than 0.01 dB
    std::size_t flips = 0;     ///< links that are up in one case only
    double worst = 0;          ///< change of the loss that is largest in size [dB]
    double rms = 0;            ///< root mean square change [dB]
    double steepest = 0;       ///< [dB/mm]
    std::uint64_t lost = 0;    ///< receptions that the run as given has and this one has not
    std::uint64_t gained = 0;  ///< receptions that only this run has
};

/// Findings about a scenario.
struct Probe {
    std::string model;
    std::size_t links = 0;
    std::uint64_t deliveries = 0;  ///< messages received in the run as given, one per robot
    Time until = start_of_run;     ///< [ns] messages until then are compared
    bool whole_run = true;         ///< that is the end of the run
    std::vector<PerturbationEffect> perturbations;
    /// Links whose loss changes: cliffs first, by steepness; then those that go up or down, then
    /// others, both by their change.
    std::vector<LinkEffect> effects;
    /// Messages in order of time, by perturbation.
    std::vector<MessageEffect> messages;
};

/// Probes a scenario. Links are those that sample_links() finds in its own replication, by its own
/// model; each end is moved east, north, west and south, unless it would come into a wall. Then the
/// scenario is run as given and under each perturbation, with the same seed, to see who gets which
/// message. That is one run more than there are perturbations.
///
/// A robot's own model counts for the messages only, and there its antenna is not moved.
/// @param scenario  with its walls loaded, as by load_scenario()
/// @param tell      told the share that is done, 0 ... 1; may be empty
/// @throws InputError, RunError as a run; InputError if no two robots come within reach
Probe probe(const Scenario& scenario, const ProbeSize& size,
            const std::function<void(double)>& tell = {});

}  // namespace rovernet
