// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/listeners.hpp"

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace rovernet {

/// Page that a web server sends to browsers.
struct WebPage {
    std::string type;  ///< media type: "text/html; charset=utf-8"
    std::string text;
    bool is_public = false;   ///< whether no token is needed: the page has no data of the run
    std::string policy = {};  ///< Content-Security-Policy of the page; empty: none
};
/// Web pages by path, such as "/". The server serves no other path, and reads no file.
using WebPages = std::map<std::string, WebPage, std::less<>>;

/// Server for WebSocket clients (RFC 6455), including browsers. Connections carry whole messages.
/// The class Admission decides which clients may connect, and get pages.
///
/// | limit                              | value          | beyond it                     |
/// |------------------------------------|----------------|-------------------------------|
/// | request for a WebSocket            | 8 KiB, in 10 s | closed                        |
/// | message of a client                | 1 MiB          | closed, 1009                  |
/// | incomplete messages of all clients | 64 MiB         | closed, 1013                  |
/// | input of a client per second       | InputRate      | not read for a while          |
/// | unsent messages to a client        | 1,024 or 4 MiB | closed, 1013                  |
/// | unsent bytes to a client           | 256 KiB        | its input is not read         |
/// | silence of a client                | 15 s           | ping; closed after 30 s       |
/// | connections                        | 500            | see below                     |
///
/// Beyond 500 connections, a new connection replaces the oldest one that is not admitted yet. If
/// there is no such connection, the new one is closed immediately.
///
/// The longest queued message of a client does not count in the limit of 4 MiB.
class WebSockets {
  public:
    using Connection = Listeners::Connection;
    /// Least number of a WebSocket connection; TCP and Unix connections have smaller numbers.
    static constexpr Connection first = 1U << 31U;

    /// Timeouts after which clients are disconnected.
    struct Timeouts {
        std::chrono::milliseconds request = std::chrono::seconds(10);
        /// Largest silence of a client, after which the connection is closed. A ping is sent after
        /// half of this time.
        std::chrono::milliseconds silence = std::chrono::seconds(30);
    };

    /// @param listeners  owner of the event loop: Listeners::wait() also runs this server; must
    ///                   outlive this object
    explicit WebSockets(Listeners& listeners) : WebSockets(listeners, Timeouts{}) {}
    WebSockets(Listeners& listeners, Timeouts timeouts);
    ~WebSockets();
    WebSockets(const WebSockets&) = delete;
    WebSockets& operator=(const WebSockets&) = delete;

    /// Listens for clients. @param users  handlers, called once for each complete message
    /// @param address  address of this machine; port 0: any free port
    /// @param pages    pages for GET and HEAD
    /// @return listening address with the actual port
    /// @throws RunError if the address is in use, or not an address of this machine
    Address listen(const Address& address, Listeners::Streams users, WebPages pages = {});
    /// Address of this server for other machines, with their token: "HOST:PORT/?token=TOKEN".
    std::string address_with_token(const Address& own) const;
    /// Address of the page "/" for browsers: "http://127.0.0.1:7007/", with the token where it is
    /// needed.
    std::string page_address(const Address& own) const;
    /// Sentence for the user with the token that clients of the address `own` need.
    std::string token_notice(const Address& own) const;

    /// Sends a text message to a client; send_binary() sends a binary message.
    void send(Connection to, std::string_view text);
    void send_binary(Connection to, std::string_view bytes);
    /// Number of bytes of messages to a client that are not sent yet.
    std::size_t unsent(Connection to) const;
    /// Closes a connection once all data is sent. The handler `closed` is called later, not by this
    /// call.
    void close(Connection which);
    /// Sends a close frame to every client once all data is sent, waits for the replies, and closes
    /// all connections. No handler is called.
    /// @param patience  longest wait in which no client takes any data
    /// @param most      longest wait altogether
    void close(std::chrono::milliseconds patience, std::chrono::milliseconds most);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rovernet
