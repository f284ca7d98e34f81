// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "sim/time.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

// Effect of small changes (perturbations) of a scenario on its links and messages. A result that a
// perturbation changes depends on the drawing of the map or on exact positions.

namespace rovernet {

/// Limits of the work of probe().
struct ProbeSize {
    std::uint32_t times = 20;  ///< number of times at which links are sampled
    std::size_t links = 1000;  ///< largest number of sampled links
    /// Number of events in the part of the run in which messages are compared; 0: no comparison.
    std::uint64_t events = 1'000'000;
    std::size_t messages = 100;  ///< largest number of message changes listed for each perturbation
};

/// Effect of one perturbation on a link. If the perturbation displaces antennas, the members are
/// values for the displacement with the largest change of loss.
struct LinkEffect {
    std::string link;          ///< name of the link: end points and time
    std::string perturbation;  ///< name, such as "resolution x2" or "1 cm east of the sender"
    double distance = 0;       ///< distance between the antennas [m]
    double budget = 0;         ///< link budget: largest loss at which the link is up [dB]
    double before = 0;         ///< path loss without perturbation [dB]
    double after = 0;          ///< path loss with the perturbation [dB]
    double moved = 0;          ///< displacement of one antenna [m]; 0: not displaced

    double change() const { return after - before; }  ///< change of the path loss [dB]
    bool was_up() const { return before <= budget; }
    bool is_up() const { return after <= budget; }
    bool flips() const { return was_up() != is_up(); }
    /// Change of the loss per displacement [dB/mm]; 0 without a displacement.
    double steepness() const;
    /// Whether the loss changes by more than 0.5 dB per mm.
    bool is_cliff() const { return steepness() > cliff; }

    static constexpr double cliff = 0.5;  // limit above which a loss changes steeply [dB/mm]
};

/// Message that a robot received in only one of two runs (with and without a perturbation).
struct MessageEffect {
    std::string from, at;  ///< names of sender and receiver
    std::uint32_t number;  ///< number of the message among the messages of `from`, from 0
    Time sent;
    std::string perturbation;
    bool gained;  ///< true: received only with the perturbation; false: only without it
};

/// Effect of one perturbation on all links and messages.
struct PerturbationEffect {
    std::string name;
    std::string nothing;       ///< reason why the scenario was not perturbed; empty: perturbed
    std::size_t changed = 0;   ///< number of links whose loss changes by more than 0.01 dB
    std::size_t flips = 0;     ///< number of links that the perturbation switches up or down
    double worst = 0;          ///< largest change of a link's loss by absolute value, with sign
                               ///< [dB]
    double rms = 0;            ///< root mean square change of the loss [dB]
    double steepest = 0;       ///< largest change of the loss per displacement [dB/mm]
    std::uint64_t lost = 0;    ///< number of receptions that only the unperturbed run has
    std::uint64_t gained = 0;  ///< number of receptions that only the perturbed run has
};

/// Result of a probe: effects of small changes (perturbations) on a scenario's links and messages.
struct Probe {
    std::string model;
    std::size_t links = 0;
    /// Number of receptions in the unperturbed run: one for each message and receiving robot.
    std::uint64_t deliveries = 0;
    Time until = start_of_run;  ///< [ns] end of the part of the run in which messages are compared
    bool whole_run = true;      ///< whether `until` is the end of the run
    std::vector<PerturbationEffect> perturbations;
    /// Effects on links whose loss changes. Links with a change above 0.5 dB per mm come first,
    /// sorted by steepness; then links that go up or down, sorted by change; then other links,
    /// sorted by change.
    std::vector<LinkEffect> effects;
    /// Messages that a robot received in only one of two runs (with and without perturbation), by
    /// perturbation, then in order of time.
    std::vector<MessageEffect> messages;
};

/// Probes a scenario. Links are sampled by sample_links(), in the scenario's replication and with
/// its model. Each end point is displaced east, north, west and south, unless it would enter a
/// wall. Then the scenario is run once unperturbed and once with each perturbation, with the same
/// seed, to compare received messages.
///
/// If a single robot has its own propagation model, this model affects messages only. The antenna
/// of such a robot is not displaced in the runs.
/// @param scenario  scenario with its walls loaded, as by load_scenario()
/// @param tell      called with the finished share, 0 ... 1; may be empty
/// @throws InputError, RunError as a run; InputError if no two robots come within range
Probe probe(const Scenario& scenario, const ProbeSize& size,
            const std::function<void(double)>& tell = {});

}  // namespace rovernet
