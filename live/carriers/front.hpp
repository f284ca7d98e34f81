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
    std::size_t number;  ///< index of the address among the front's addresses, from 0
    std::uint16_t port;
};

/// Protocol server for external programs in a live run: parses the clients' messages, commands the
/// session, and sends messages to clients at simulated times that it chooses.
///
/// A front uses neither sockets nor clocks: run_paced() calls it, from one thread. At each call the
/// session has processed all events of its current time. If programs send packets, each robot's
/// PacketPort is a connection, which has the robot's number and exists from the start.
///
/// A front may ask for the run to begin anew. Then it keeps its connections, and begin() is called
/// again; each other front is replaced by a new one, and its connections are closed.
class Front {
  public:
    /// Number of a client's connection, unique in the run.
    using Connection = std::uint32_t;

    /// Functions by which a front reaches its clients. They never call the front back at once: a
    /// connection that they end is reported by closed() later.
    struct Carrier {
        /// Sends one message to a client. A client that does not read its messages is disconnected.
        std::function<void(Connection to, std::string_view message)> send;
        /// Closes a connection, once all messages to it are sent.
        std::function<void(Connection which)> close;
        /// Sends one binary message to a client; for protocols with text and binary messages.
        std::function<void(Connection to, std::string_view message)> send_binary = {};
        /// Fingerprint of the run so far.
        std::function<std::string()> fingerprint = {};
    };

    virtual ~Front() = default;

    /// Starts the run. Session and scenario outlive the front.
    virtual void begin(Session& session, const Scenario& scenario) = 0;
    virtual void opened(Connection client, ListenerId at) = 0;
    /// Handles bytes from a client: any piece of its stream, in order; or one message of a
    /// WebSocket; or one packet; or one line, without its end.
    /// @return number of messages that are now complete; 0 for a line outside the protocol
    virtual std::size_t received(Connection from, std::string_view bytes) = 0;
    virtual void closed(Connection gone) = 0;

    /// Time of the front's next message to clients; `never` if there is none.
    virtual Time next() const = 0;
    /// Sends the messages that are due at the current time, which is next().
    virtual void tell() = 0;

    /// Time at which the run must wait for further messages of clients.
    virtual Time limit() const { return never; }
    /// Called now and then while the run waits at limit().
    /// @param waited  real time since the run has reached the limit
    virtual void held(std::chrono::nanoseconds /*waited*/) {}
    /// Whether the clients are done, so that the run ends.
    virtual bool is_done() const { return false; }
    /// Whether clients have the last word: the end of the scenario does not end the run.
    virtual bool holds_end() const { return false; }
    /// Seed with which the run must begin anew; none: it goes on.
    virtual std::optional<std::uint64_t> new_seed() const { return std::nullopt; }
    /// Called once the results are written; messages to clients are still sent.
    /// @param metrics  as in summary.json
    virtual void ended(std::string_view /*fingerprint*/, const Table& /*metrics*/) {}
    /// Error of a client that ended the run; empty: none.
    virtual std::string fault() const { return {}; }
    /// Adds counters to the table `live` of summary.json.
    virtual void report(Table&) const {}
};

}  // namespace rovernet
