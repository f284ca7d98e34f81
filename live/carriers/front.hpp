// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/session.hpp"
#include "scenario/scenario.hpp"
#include "scenario/document/value.hpp"
#include "sim/time.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>

namespace rovernet {

/// Address at which a client came in.
struct Entrance {
    std::size_t number;  ///< among the addresses of its front, from 0
    std::uint16_t port;
};

/// Protocol in which programs outside take part in a paced run: it reads what its clients send,
/// commands the session, and tells the clients what happens at simulated times of its own.
///
/// It knows no sockets and no clocks: run_paced() calls it, from one thread. Whatever it is called
/// for, the session has served all events of its present time. Where programs send packets, each
/// robot's PacketPort is a connection, which has the robot's number and is there from the start.
class Front {
  public:
    /// Number of a client's connection, never used twice.
    using Connection = std::uint32_t;

    /// Ways to a client. They never call back: a connection that they end is told of by closed(),
    /// later.
    struct Carrier {
        /// Sends one message. A client that does not read what it is sent is disconnected.
        std::function<void(Connection to, std::string_view message)> send;
        /// Ends a connection, once all that was sent is out.
        std::function<void(Connection which)> close;
        /// Sends one message that is no text, where clients tell one from the other.
        std::function<void(Connection to, std::string_view message)> send_binary = {};
    };

    virtual ~Front() = default;

    /// The run begins. Both live as long as the front does.
    virtual void begin(Session& session, const Scenario& scenario) = 0;
    virtual void opened(Connection client, Entrance at) = 0;
    /// Bytes came from a client: any part of what it sends, in order; one message of a WebSocket,
    /// or one packet.
    /// @return number of messages that have become whole
    virtual std::size_t received(Connection from, std::string_view bytes) = 0;
    virtual void closed(Connection gone) = 0;

    /// Time at which it has something to tell next; `never` if it has not.
    virtual Time next() const = 0;
    /// Tells what is to be told at the present time, which is next().
    virtual void tell() = 0;

    /// Time beyond which the run must not go before a client has said more.
    virtual Time limit() const { return never; }
    /// Its clients have done all that they came for: the run ends.
    virtual bool is_done() const { return false; }
    /// Adds what it counted to the table `live` of summary.json.
    virtual void report(Table&) const {}
};

}  // namespace rovernet
