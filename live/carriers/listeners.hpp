// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/address.hpp"
#include "live/carriers/request.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace boost::asio {
class io_context;
}

namespace rovernet {

/// Listeners and connections to external programs: TCP on this machine, Unix sockets, and standard
/// input and output of started programs. Connections carry lines or bytes. Only this class and
/// WebSockets use sockets (Boost.Asio); all work is done in the calling thread.
///
/// The next line of a client is read after the answer to the previous line is sent. So a client
/// that sends without reading does not fill the memory, and may send several lines in advance. A
/// byte stream is read as it arrives, and messages to its client may be sent at any time.
///
/// If a client's first line is no JSON object, the client gets an error and is disconnected, as
/// soon as the bytes received so far cannot begin an object. No line of this client is executed.
/// Reason: any web page can make a browser send an HTTP request to this machine, with arbitrary
/// lines in its body. An HTTP request begins with a word, never with a brace (RFC 9110, 9.1).
///
/// | limit                               | value           | beyond it                 |
/// |-------------------------------------|-----------------|---------------------------|
/// | line                                | 1 MiB           | "too_long", closed        |
/// | queued lines of all clients         | 64 MiB          | "too_long", closed        |
/// | input of a stream per second        | InputRate       | not read for a while      |
/// | unsent messages to a stream         | 1,024 or 4 MiB  | last message, closed (1 s)|
/// | unsent bytes to a stream            | 256 KiB         | its input is not read     |
/// | connections                         | 500             | see below                 |
/// | time for a complete line or message | 60 s            | closed                    |
/// | silence of the client's machine     | 30 s            | 3 TCP probes within 30 s  |
///
/// Beyond 500 connections, a new connection replaces the oldest one that has not sent a complete
/// line or message yet. If there is no such connection, the new one is closed immediately.
class Listeners {
  public:
    using Connection = std::uint32_t;
    /// Handlers of connections that carry bytes or lines. The handlers may call send() and close().
    struct Streams {
        std::function<void(Connection opened)> opened = [](auto) {};
        /// Handles received bytes, or a line without its end. @return number of messages that are
        /// now complete; 0 for a line that does not belong to the protocol
        std::function<std::size_t(Connection from, std::string_view bytes)> received =
            [](auto, auto) { return std::size_t{0}; };
        std::function<void(Connection gone)> closed = [](auto) {};
        /// Whether the input rate of clients is limited, see InputRate; only for byte streams.
        bool has_rate = true;
        /// Function for the last message to a client of a byte stream that is disconnected because
        /// it does not read. `lost`: number of messages to the client that are dropped.
        std::function<std::string(std::size_t lost)> closing_message = [](auto) {
            return std::string();
        };
        /// Function for the line that reports to a client why it is disconnected; empty: the
        /// connections carry bytes, not lines.
        std::function<std::string(const RequestError& why)> line_error = {};
    };

    Listeners();
    /// Closes all connections; ends programs that still run.
    ~Listeners();
    Listeners(const Listeners&) = delete;
    Listeners& operator=(const Listeners&) = delete;

    /// Starts a program by the shell, and connects to its standard input and output.
    /// @return connection of the program; none if there are too many connections
    /// @throws RunError if the program cannot be started
    std::optional<Connection> start(const std::string& command, Streams streams);
    /// Listens on an address for clients. May be called for several addresses. Access is not
    /// restricted.
    /// @param address  port 0: any free port
    /// @return listening address with the actual port
    /// @throws RunError if the address is in use, or not an address of this machine
    Address listen(const Address& address, Streams streams);
    /// Listens on a Unix socket, accessible to this user only. A stale socket file is replaced.
    /// @throws RunError if the path cannot be used
    void listen_unix(const std::string& path, Streams streams);

    /// Calls `readable` whenever a descriptor has data to read, until `readable` returns false.
    /// @throws RunError
    void watch(int descriptor, std::function<bool()> readable);

    /// Sends a message to a client. If the connection carries lines, the message is the answer to
    /// the client's last line; send() appends the end of the line. If the connection carries bytes,
    /// the message is sent unchanged.
    void send(Connection to, std::string_view message);
    /// Closes a connection once all data is sent. The handler `closed` is called later, not by this
    /// call.
    void close(Connection which);
    /// Waits at most `most` for one event, such as received bytes, and calls the handler of the
    /// event. May return without an event.
    void wait(std::chrono::nanoseconds most);
    /// Event loop that wait() runs, for other servers of this process, such as WebSockets.
    boost::asio::io_context& io();
    /// Sends all remaining data, then closes all connections. Sending ends after `soon` for clients
    /// of byte streams, and after `most` for clients of lines. Then waits at most `most` for
    /// started programs, and ends those that still run. No handler is called any more.
    /// @return errors of programs: "python3 x.py ended with exit code 1"
    std::vector<std::string> close(std::chrono::milliseconds soon, std::chrono::milliseconds most);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rovernet
