// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/address.hpp"
#include "live/carriers/front.hpp"
#include "live/logged_run.hpp"
#include "live/carriers/packet_port.hpp"
#include "scenario/scenario.hpp"

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Front of a run and the addresses where clients come in.
struct FrontDoor {
    struct Entry {
        Address at;        ///< port 0: any that is free
        std::string what;  ///< what it is for: "Player, robot A"
    };

    using Ports = std::vector<std::unique_ptr<PacketPort>>;

    std::vector<Entry> entries;
    std::function<std::unique_ptr<Front>(Front::Carrier)> make;
    bool is_web = false;  ///< clients speak WebSocket: the front gets and sends whole messages
    /// Last message to a client that does not read what it is sent, see Doors::Streams.
    std::function<std::string(std::size_t lost)> farewell = {};
    /// In place of entries: opens a port for each robot, as the run begins.
    std::function<Ports(const Network&)> open_ports = {};
};

/// How a scenario is run by the clock, while clients come and go.
struct PacedOptions {
    std::string folder = {};          ///< for the results
    std::optional<double> speed = 1;  ///< simulated per real time; none: as fast as fronts let it
    std::vector<FrontDoor> fronts = {};
    /// Real time by which it may be behind the clock. Beyond that it says so, once, or ends with a
    /// fault if `late_ends`. None: any.
    std::optional<Duration> most_late = {};
    bool late_ends = false;
    /// Real time, by which the run is paced.
    std::function<std::chrono::steady_clock::time_point()> clock = std::chrono::steady_clock::now;
    StopRules stop = {};
    /// Told what a person should know: addresses that are listened on.
    std::function<void(std::string_view)> say = [](std::string_view) {};
};

/// Runs a scenario by the clock, and lets clients take part in it. It ends with the scenario, when
/// a front is done, or when it is told to; then its results and the log of inputs are written, as
/// by run_live(). The clock decides only at which simulated time an input is accepted. It stands
/// still while a front's limit() holds the run.
/// @throws InputError, RunError
LiveResult run_paced(Scenario scenario, const PacedOptions& options);

}  // namespace rovernet
