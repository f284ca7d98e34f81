// SPDX-License-Identifier: MIT
#pragma once

#include "live/loopback.hpp"
#include "sim/error.hpp"

#include <boost/asio.hpp>
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <netinet/tcp.h>
#include <string>
#include <sys/socket.h>
#include <utility>

// What everything that listens on sockets (Boost.Asio) does the same way.

namespace rovernet {

/// Listens on an address of this machine. @throws RunError if it is in use
inline boost::asio::ip::tcp::acceptor listen_on(boost::asio::io_context& io,
                                                const Loopback& address) {
    namespace asio = boost::asio;
    try {
        return {io, asio::ip::tcp::endpoint(asio::ip::make_address(address.host), address.port)};
    } catch (const boost::system::system_error& fault) {
        throw RunError(fmt::format("{}: {}", address.text(), fault.code().message()));
    }
}

/// Has what was received last acknowledged at once. A client that writes a command and a request,
/// and has not switched off Nagle's algorithm, would wait 40 ms for that in each round.
inline void acknowledge_at_once(int socket) {
    const int on = 1;
    setsockopt(socket, IPPROTO_TCP, TCP_QUICKACK, &on, sizeof on);
}

/// Gives each connection that comes in to `take`, as long as the acceptor is there.
template <class Acceptor, class Take>
void accept_all(Acceptor& acceptor, Take take) {
    namespace asio = boost::asio;
    acceptor.async_accept([&acceptor, take](boost::system::error_code error, auto socket) {
        if (error == asio::error::operation_aborted) return;
        if (!error) {
            take(std::move(socket));
            return accept_all(acceptor, take);
        }
        // No descriptor is free, say: that passes.
        constexpr auto again_after = std::chrono::milliseconds(100);
        auto timer = std::make_shared<asio::steady_timer>(acceptor.get_executor(), again_after);
        timer->async_wait(
            [&acceptor, take, timer](boost::system::error_code) { accept_all(acceptor, take); });
    });
}

}  // namespace rovernet
