// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/listeners.hpp"

#include <chrono>
#include <memory>
#include <string>
#include <string_view>

namespace rovernet {

/// Carrier of whole messages between clients that speak WebSocket (RFC 6455), browsers among them,
/// and this process. Who may come in, Admission says.
///
/// | limit                              | value          | beyond it                     |
/// |------------------------------------|----------------|-------------------------------|
/// | request for a WebSocket            | 8 KiB, in 10 s | closed                        |
/// | message of a client                | 1 MiB          | closed, 1009                  |
/// | messages of all, not yet whole     | 64 MiB         | closed, 1013                  |
/// | what a client says in a second     | InputRate      | it is not read for a while    |
/// | messages to a client, not taken yet| 1,024 or 4 MiB | closed, 1013                  |
/// | bytes to a client, not taken yet   | 256 KiB        | what it says is not read      |
/// | silence of a client                | 15 s           | pinged; after 30 s it is gone |
/// | connections                        | 500            | see below                     |
///
/// One connection more takes the place of the oldest that is not let in yet. If all are, it is
/// closed at once.
///
/// The longest message that waits for a client does not count in those 4 MiB.
class WebSockets {
  public:
    using Connection = Doors::Connection;
    static constexpr Connection first = 1U << 31U;  ///< those of Doors are below

    /// How long clients are waited for.
    struct Patience {
        std::chrono::milliseconds for_request = std::chrono::seconds(10);
        /// For anything that a client sends; after half of it a ping asks for something.
        std::chrono::milliseconds for_silence = std::chrono::seconds(30);
    };

    /// @param doors  in whose wait() everything happens; they have to live longer
    explicit WebSockets(Doors& doors) : WebSockets(doors, Patience{}) {}
    WebSockets(Doors& doors, Patience patience);
    ~WebSockets();
    WebSockets(const WebSockets&) = delete;
    WebSockets& operator=(const WebSockets&) = delete;

    /// Listens for clients, whose users are told of each message as it is whole.
    /// @param address  port 0: any that is free
    /// @return the address with the port
    /// @throws RunError if it is in use, or none of this machine
    Address listen(const Address& address, Doors::Streams users);
    /// Sentence with the token, for the person who started this: who comes in at an address by it.
    std::string invitation(const Address& own) const;
    /// Text that clients have to know, as Admission has it.
    const std::string& token() const;
    bool listens() const;

    /// Sends a message: a text, or bytes.
    void send(Connection to, std::string_view text);
    void send_binary(Connection to, std::string_view bytes);
    /// Closes a connection once all is out. It is told as closed, but not by this call.
    void close(Connection which);
    /// Says goodbye to all once all is out, waits for their answers, at most so long, and closes
    /// everything. Nobody is told of that.
    void close(std::chrono::milliseconds most);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rovernet
