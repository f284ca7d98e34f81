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

    std::vector<std::string> programs = {};  ///< shell commands that start clients
    std::vector<Entry> entries = {};
    std::optional<std::string> unix_path = {};  ///< path of a Unix socket for clients
    std::function<std::unique_ptr<Front>(Front::Carrier)> make = {};
    /// Web pages served at the WebSocket addresses; empty: the addresses serve only WebSockets.
    WebPages pages = {};
    /// Whether the input rate of clients is limited in a run paced by the clock, see InputRate.
    bool has_rate = true;
    /// Function for the last message to a client that is disconnected because it does not read.
    /// `lost`: number of messages to the client that are dropped.
    std::function<std::string(std::size_t lost)> closing_message = {};
    /// Function for the line that reports to a client why it is disconnected. If the function is
    /// given, connections by TCP, Unix socket and standard input carry lines, otherwise bytes.
    std::function<std::string(const RequestError& why)> line_error = {};
    /// Function that opens a PacketPort for each robot at the run's start, instead of `entries`.
    std::function<Ports(const Network&)> open_ports = {};
};

/// Command-line option of a live run that starts a front (protocol server) for WebSocket clients.
struct FrontOption {
    const char* name;        ///< name of the option: "--rosbridge"
    const char* serves;      ///< clients of the front: "ROS clients by the rosbridge protocol"
    std::string_view usual;  ///< listening address if the option has no value
    FrontListeners (*listeners)(const Address& at);
};

/// Options of a live run, with clients that may connect and leave.
struct PacedOptions {
    std::string folder = {};  ///< folder for the results of the run
    /// Simulated time over real time [-]; none: as fast as the fronts (protocol servers) permit.
    std::optional<double> speed = 1;
    std::vector<FrontListeners> fronts = {};
    /// Largest allowed delay of the run behind the clock. At a larger delay the run prints a notice
    /// (once), or ends with an error if `late_ends`. None: no limit.
    std::optional<Duration> most_late = {};
    bool late_ends = false;
    /// Function that reads the clock that paces the run.
    std::function<std::chrono::steady_clock::time_point()> clock = std::chrono::steady_clock::now;
    StopRules stop = {};
    /// Called with the results as soon as they are written, if a front goes on to serve its
    /// clients.
    std::function<void(const RunResult&)> finished = [](const RunResult&) {};
    /// Called with notices for the user, such as listening addresses.
    std::function<void(std::string_view)> say = [](std::string_view) {};
};

/// Runs a scenario whose robots are commanded by clients of fronts (protocol servers). Simulated
/// time follows the clock, or advances as fast as the fronts permit. The run ends at the end of the
/// scenario, unless a front's holds_end() delays the end. The run ends earlier if a front is done
/// or `stop` ends the run. Then results and input log are written. The clock only determines the
/// simulated time of an input. The clock pauses while a front's limit() blocks the run.
/// @throws InputError, RunError, Interrupted; std::invalid_argument for an overlong Unix path
LiveResult run_paced(Scenario scenario, const PacedOptions& options);

}  // namespace rovernet
