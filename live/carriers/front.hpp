// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/session.hpp"
#include "scenario/document/value.hpp"
#include "scenario/scenario.hpp"
#include "sim/time.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace rovernet {

/// Listening address at which a client connected.
struct ListenerId {
    std::size_t number;  ///< index among the addresses of the Front (protocol server), from 0
    std::uint16_t port;
};

/// Protocol server for external programs in a live run: parses the clients' messages, commands the
/// session, and sends messages to clients at simulated times chosen by the server.
///
/// A front uses neither sockets nor clocks: run_paced() calls it, from one thread. At each call the
/// session has processed all events of its current time. If programs send packets, each robot's
/// PacketPort is a connection, which has the robot's number and exists from the start.
///
/// A front may request by new_seed() that the run starts again. The front then keeps its
/// connections, and begin() is called again. All other fronts of the run are replaced by new
/// fronts, and their connections are closed.
class Front {
  public:
    /// Number of a client's connection, unique in the run.
    using Connection = std::uint32_t;

    /// Functions by which a front (protocol server) reaches its clients. The functions do not call
    /// the front directly: a connection ended by a function is reported to closed() later.
    struct Carrier {
        /// Sends one message to a client. A client that does not read its messages is disconnected.
        std::function<void(Connection to, std::string_view message)> send;
        /// Closes a connection after all messages to the client are sent.
        std::function<void(Connection which)> close;
        /// Sends one binary message to a client; for protocols with text and binary messages.
        std::function<void(Connection to, std::string_view message)> send_binary = {};
        /// Returns the fingerprint (hash of all records) of the run so far.
        std::function<std::string()> fingerprint = {};
        /// Returns the number of bytes that are not sent to a WebSocket client yet.
        std::function<std::size_t(Connection to)> unsent = {};
        /// Sets the ratio of simulated time to real time [-] from now on; none: as fast as the
        /// fronts permit.
        std::function<void(std::optional<double>)> set_speed = {};
    };

    virtual ~Front() = default;

    /// Called before the first event of a run, so that the front may add sinks.
    virtual void prepare(Session& /*session*/, const Scenario& /*scenario*/) {}
    /// Starts the run, when all events of its start have been processed. The session ends with the
    /// run; the scenario outlives the front.
    virtual void begin(Session& session, const Scenario& scenario) = 0;
    virtual void opened(Connection client, ListenerId at) = 0;
    /// Called before begin() for each program that was started for this front.
    virtual void started(Connection /*program*/, const std::string& /*command*/) {}
    /// Handles input from a client: the next piece of its byte stream, one WebSocket message, one
    /// packet, or one line without its end.
    /// @return number of messages that the input completes; 0 for a line outside the protocol
    virtual std::size_t received(Connection from, std::string_view bytes) = 0;
    virtual void closed(Connection gone) = 0;

    /// Simulated time at which the front sends its next messages to clients, by tell(); `never` if
    /// no message is planned.
    virtual Time next() const = 0;
    /// Sends messages to clients. Called when simulated time has reached next().
    virtual void tell() = 0;
    /// Whether the simulated time in tell() must be exactly next(). Otherwise tell() may be called
    /// some microseconds later, so that the receptions of a frame are not separated.
    virtual bool is_exact() const { return true; }

    /// Simulated time at which the run stops and waits until clients have sent the messages that
    /// the front needs; `never`: no limit.
    virtual Time limit() const { return never; }
    /// Called repeatedly while the run waits at limit(), and while the front stays after the run.
    /// @param waited  real time since the run has reached the limit
    virtual void held(std::chrono::nanoseconds /*waited*/) {}
    /// Whether an error ended the run before all clients of its start had connected. Then no
    /// results are written.
    virtual bool failed_to_begin() const { return false; }
    /// Whether the clients are done, so that the run ends.
    virtual bool is_done() const { return false; }
    /// Whether the run continues at the end of the scenario, until its clients end it.
    virtual bool holds_end() const { return false; }
    /// Seed of the new run, if the run must start again; none: the run continues.
    virtual std::optional<std::uint64_t> new_seed() const { return std::nullopt; }
    /// Called once the results are written. Messages sent in this call still reach the clients.
    /// @param metrics  metrics of the run, as in summary.json
    virtual void ended(std::string_view /*fingerprint*/, const Table& /*metrics*/) {}
    /// Whether the front continues to serve its clients after ended(), until the user stops the
    /// program.
    virtual bool stays() const { return false; }
    /// Error that ended the run, such as a lost client; empty: no error.
    virtual std::string fault() const { return {}; }
    /// Longest real time in which started programs may end by themselves after the run.
    virtual std::chrono::milliseconds time_to_end() const { return std::chrono::seconds(10); }
    /// Adds the front's counters to the table `live` of summary.json.
    virtual void report(Table&) const {}
};

}  // namespace rovernet
