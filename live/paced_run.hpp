// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/address.hpp"
#include "live/carriers/front.hpp"
#include "live/carriers/packet_port.hpp"
#include "live/carriers/web_sockets.hpp"
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

/// Front (protocol server) of a run, with the ways by which its clients connect.
struct FrontListeners {
    struct Entry {
        Address at;             ///< listening address; port 0: any free port
        std::string what = {};  ///< description of the address: "Player, robot A"; may be empty
        /// True: clients use WebSocket, so that the front gets and sends whole messages.
        bool is_web = false;
    };

    using Ports = std::vector<std::unique_ptr<PacketPort>>;

    std::vector<std::string> programs = {};  ///< programs to start as clients, by the shell
    std::vector<Entry> entries = {};
    std::optional<std::string> unix_path = {};  ///< path of a Unix socket for clients
    std::function<std::unique_ptr<Front>(Front::Carrier)> make = {};
    /// Pages of the WebSocket addresses; none: only WebSockets are served there.
    WebPages pages = {};
    /// Whether the input rate of clients is limited in a run by the clock, see InputRate.
    bool has_rate = true;
    /// Last message to a client that does not read its messages, see Listeners::Streams.
    std::function<std::string(std::size_t lost)> closing_message = {};
    /// Line that tells a client why it is disconnected; none: clients of TCP, Unix socket and
    /// standard input send bytes, not lines.
    std::function<std::string(const RequestError& why)> line_error = {};
    /// Instead of `entries`: function that opens a port for each robot at the start of the run.
    std::function<Ports(const Network&)> open_ports = {};
};

/// Option of the commands that serve programs, for a front whose clients use WebSocket.
struct FrontOption {
    const char* name;        ///< "--rosbridge"
    const char* serves;      ///< whom it serves: "ROS clients by the rosbridge protocol"
    std::string_view usual;  ///< address of an option without a value
    FrontListeners (*listeners)(const Address& at);
};

/// Options of a live run, with clients that may connect and leave.
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

/// Runs a scenario paced by the clock, or as fast as the fronts permit, with clients of the fronts.
/// The run ends with the scenario, when a front is done, or when `stop` ends it; at the end of the
/// scenario it waits for fronts that hold it. Then results and input log are written. The clock
/// only determines the simulated time at which an input is accepted. It pauses while a front's
/// limit() blocks the run.
/// @throws InputError, RunError, Interrupted; std::invalid_argument for an overlong Unix path
LiveResult run_paced(Scenario scenario, const PacedOptions& options);

}  // namespace rovernet
