// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/address.hpp"
#include "sim/error.hpp"

#include <boost/asio.hpp>
#include <fmt/format.h>

#include <chrono>
#include <cstddef>
#include <linux/sockios.h>
#include <memory>
#include <netinet/tcp.h>
#include <stdexcept>
#include <string>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>
#include <utility>

// Accept loop, pauses and socket options shared by all listeners (Boost.Asio).

namespace rovernet {

/// Opens a TCP listener on an address of this machine. @throws RunError if the address is in use
inline boost::asio::ip::tcp::acceptor listen_on(boost::asio::io_context& io,
                                                const Address& address) {
    namespace asio = boost::asio;
    try {
        return {io, asio::ip::tcp::endpoint(asio::ip::make_address(address.host), address.port)};
    } catch (const boost::system::system_error& fault) {
        throw RunError(
            fmt::format("cannot listen on {}: {}", address.text(), fault.code().message()));
    }
}

/// Opens a listener on a Unix socket, accessible to this user only. A stale socket file is
/// replaced.
/// @throws RunError if the path is a socket in use, or a file that is no socket;
/// std::invalid_argument for an overlong path
inline boost::asio::local::stream_protocol::acceptor listen_on_path(boost::asio::io_context& io,
                                                                    const std::string& path) {
    using boost::asio::local::stream_protocol;
    if (path.empty() || path.size() >= sizeof(sockaddr_un::sun_path)) {
        throw std::invalid_argument(
            fmt::format("{}: expected a path of 1 to {} bytes for the Unix socket", path,
                        sizeof(sockaddr_un::sun_path) - 1));
    }
    const stream_protocol::endpoint endpoint(path);
    struct stat found {};
    if (lstat(path.c_str(), &found) == 0) {
        stream_protocol::socket probe(io);
        boost::system::error_code error;
        probe.connect(endpoint, error);
        if (!S_ISSOCK(found.st_mode) || !error)
            throw RunError(
                path +
                ": there is already a file, or a socket in use, with this path; expected a "
                "different path for the Unix socket");
        unlink(path.c_str());
    }
    const mode_t mask = umask(0077);
    try {
        stream_protocol::acceptor acceptor(io, endpoint);
        umask(mask);
        return acceptor;
    } catch (const boost::system::system_error& fault) {
        umask(mask);
        throw RunError(fmt::format("cannot listen on {}: {}", path, fault.code().message()));
    }
}

/// Enables TCP keep-alive: after 30 s of silence the peer is probed three times, at intervals of
/// 10 s. If the peer does not reply, the connection is closed.
inline void keep_alive(int socket) {
    const int on = 1, silence = 30, interval = 10, times = 3;  // silence and interval in s
    setsockopt(socket, SOL_SOCKET, SO_KEEPALIVE, &on, sizeof on);
    setsockopt(socket, IPPROTO_TCP, TCP_KEEPIDLE, &silence, sizeof silence);
    setsockopt(socket, IPPROTO_TCP, TCP_KEEPINTVL, &interval, sizeof interval);
    setsockopt(socket, IPPROTO_TCP, TCP_KEEPCNT, &times, sizeof times);
}

/// Acknowledges the last received data immediately (TCP_QUICKACK). Otherwise a client with Nagle's
/// algorithm that writes a command and then a request would wait 40 ms for each answer.
inline void acknowledge_at_once(int socket) {
    const int on = 1;
    setsockopt(socket, IPPROTO_TCP, TCP_QUICKACK, &on, sizeof on);
}

/// Number of sent bytes that the peer has not acknowledged [bytes].
inline std::size_t unacknowledged(int socket) {
    int bytes = 0;
    return ioctl(socket, SIOCOUTQ, &bytes) == 0 ? static_cast<std::size_t>(bytes) : 0;
}

/// Accepts connections as long as the acceptor exists. Calls take(socket) for each connection.
template <class Acceptor, class Take>
void accept_all(Acceptor& acceptor, Take take) {
    namespace asio = boost::asio;
    acceptor.async_accept([&acceptor, take](boost::system::error_code error, auto socket) {
        if (error == asio::error::operation_aborted) return;
        if (!error) {
            take(std::move(socket));
            return accept_all(acceptor, take);
        }
        // A temporary error, such as too many open descriptors: try again later.
        constexpr auto again_after = std::chrono::milliseconds(100);
        auto timer = std::make_shared<asio::steady_timer>(acceptor.get_executor(), again_after);
        timer->async_wait(
            [&acceptor, take, timer](boost::system::error_code) { accept_all(acceptor, take); });
    });
}

/// Calls carrier.read(client) once the client's input rate limit permits. Does nothing if the
/// client has disconnected by then.
template <class Carrier, class Client>
void read_later(Carrier& carrier, const std::shared_ptr<Client>& client) {
    using Timer = boost::asio::steady_timer;
    const auto pause = std::make_shared<Timer>(carrier.io, client->rate.read_again());
    pause->async_wait([&carrier, client, pause](boost::system::error_code) {
        client->is_reading = false;
        if (carrier.clients.contains(client->id)) carrier.read(client);
    });
}

}  // namespace rovernet
