// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/address.hpp"
#include "live/carriers/request.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace boost::asio {
class io_context;
}

namespace rovernet {

/// Carrier of lines and bytes between programs outside and this process: TCP on this machine, Unix
/// sockets, and the standard input and output of programs that it starts. It is the only one that
/// knows sockets (Boost.Asio), and everything happens in the thread that calls it.
///
/// A controller's next line is read when the last one is answered and the answer is out. So
/// nothing grows with a controller that asks without reading, and lines may be sent ahead.
/// A stream of bytes is read as it comes, and its client may be told things without asking.
///
/// A connection from outside whose first line is no JSON object is told so and closed, by its first
/// byte if that says so, and nothing of it is obeyed. Any page in a browser may have it send a
/// request (HTTP) to an address of this machine, with lines that the page has chosen in its body;
/// but a request begins with a word, never with a brace (RFC 9110, 9.1).
///
/// | limit                               | value           | beyond it                 |
/// |-------------------------------------|-----------------|---------------------------|
/// | line                                | 1 MiB           | "too_long", closed        |
/// | lines of all, not yet taken         | 64 MiB          | "too_long", closed        |
/// | what a stream says in a second      | InputRate       | it is not read for a while|
/// | messages to a stream, not taken yet | 1,024 or 4 MiB  | told so, closed in 1 s    |
/// | bytes to a stream, not taken yet    | 256 KiB         | what it says is not read  |
/// | connections                         | 500             | see below                 |
/// | time until a line or message is whole | 60 s          | closed                    |
/// | silence of the client's machine     | 30 s            | asked 3 times, in 30 s    |
///
/// One connection more takes the place of the oldest that has not said a whole line or message yet.
/// If all have, it is closed at once.
class Doors {
  public:
    using Connection = std::uint32_t;
    /// What is told of connections. The functions may call send().
    struct Users {
        /// @return whether it is a line of their protocol at all
        std::function<bool(Connection from, std::string_view line)> line;
        std::function<void(Connection to, const RequestError& why)> refuse;
        std::function<void(Connection gone)> closed;
    };

    /// What is told of connections that carry bytes. The functions may call send() and close().
    struct Streams {
        std::function<void(Connection opened)> opened = [](auto) {};
        /// @return number of messages that have become whole
        std::function<std::size_t(Connection from, std::string_view bytes)> received =
            [](auto, auto) { return std::size_t{0}; };
        std::function<void(Connection gone)> closed = [](auto) {};
        /// Its clients may say only so much in a second (InputRate).
        bool has_rate = true;
        /// Last message to a client that is closed because it takes none: so many are lost.
        std::function<std::string(std::size_t lost)> farewell = [](auto) { return std::string(); };
    };

    /// @param users  of lines; none are told if no connection carries any
    explicit Doors(Users users = {});
    /// Closes everything; programs that are still there are ended.
    ~Doors();
    Doors(const Doors&) = delete;
    Doors& operator=(const Doors&) = delete;

    /// Starts a program by the shell; it speaks by its standard input and output.
    /// @throws RunError if it cannot be started
    void start(const std::string& command);
    /// Listens on an address. Whoever reaches it may come in.
    /// @param address  port 0: any that is free
    /// @return the address with the port
    /// @throws RunError if it is in use, or none of this machine
    Address listen(const Address& address);
    /// Listens for clients that send and are sent bytes. May be called for several addresses.
    Address listen(const Address& address, Streams streams);
    /// Listens on a Unix socket, for this user alone; one that nobody listens on is replaced.
    /// @throws RunError
    void listen_unix(const std::string& path);

    /// Calls `readable` whenever a descriptor has something to read, until it returns false.
    /// @throws RunError
    void watch(int descriptor, std::function<bool()> readable);

    /// Sends a line, without its end: the answer to the last one of that controller. In a stream:
    /// a message, as it is.
    void send(Connection to, std::string_view message);
    /// Closes a connection once all is out. It is told as closed, but not by this call.
    void close(Connection which);
    /// Number of controllers that may still speak; more may come if it listens.
    std::size_t connections() const;
    bool listens() const;
    /// Waits for something to happen, at most so long, and tells of it: of one thing only. It may
    /// return without.
    void wait(std::chrono::nanoseconds most);
    /// What wait() serves, for other carriers of this process.
    boost::asio::io_context& io();
    /// Waits until all lines are out, at most so long, then closes everything and waits for the
    /// programs that it started, as long again; those who are still there are ended. Users are told
    /// of nothing any more.
    /// @return what programs came to no good end: "python3 x.py ended with 1"
    std::vector<std::string> close(std::chrono::milliseconds most);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rovernet
