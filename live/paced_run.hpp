// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/address.hpp"
#include "live/carriers/front.hpp"
#include "live/carriers/packet_port.hpp"
#include "live/logged_run.hpp"
#include "scenario/scenario.hpp"

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Front (protocol server) of a run, with the addresses on which it listens.
struct FrontListeners {
    struct Entry {
        Address at;        ///< listening address; port 0: any free port
        std::string what;  ///< description of the address: "Player, robot A"
    };

    using Ports = std::vector<std::unique_ptr<PacketPort>>;

    std::vector<Entry> entries;
    std::function<std::unique_ptr<Front>(Front::Carrier)> make;
    /// True: clients use WebSocket, so that the front gets and sends whole messages.
    bool is_web = false;
    /// Last message to a client that does not read its messages, see Listeners::Streams.
    std::function<std::string(std::size_t lost)> closing_message = {};
    /// Instead of `entries`: function that opens a port for each robot at the start of the run.
    std::function<Ports(const Network&)> open_ports = {};
};

/// Options of a run paced by the clock, with clients that may connect and leave.
struct PacedOptions {
    std::string folder = {};  ///< folder for the results of the run
    /// Simulated time over real time; none: as fast as the fronts permit.
    std::optional<double> speed = 1;
    std::vector<FrontListeners> fronts = {};
    /// Largest allowed delay behind the clock. If the delay is larger, the run prints a notice
    /// once, or ends with an error if `late_ends`. None: no limit.
    std::optional<Duration> most_late = {};
    bool late_ends = false;
    /// Clock that paces the run.
    std::function<std::chrono::steady_clock::time_point()> clock = std::chrono::steady_clock::now;
    StopRules stop = {};
    /// Called with notices for the user, such as listening addresses.
    std::function<void(std::string_view)> say = [](std::string_view) {};
};

/// Runs a scenario paced by the clock, with clients of the fronts. The run ends with the scenario,
/// when a front is done, or when `stop` ends it. Then results and input log are written, as by
/// run_live(). The clock only determines the simulated time at which an input is accepted. It
/// pauses while a front's limit() blocks the run.
/// @throws InputError, RunError
LiveResult run_paced(Scenario scenario, const PacedOptions& options);

}  // namespace rovernet
