// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

#include <arpa/inet.h>
#include <chrono>
#include <netinet/in.h>
#include <string>
#include <string_view>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

namespace rovernet::test {

/// Socket of a program, connected to a robot's UDP port.
class Datagrams {
  public:
    explicit Datagrams(int port) : socket_(socket(AF_INET, SOCK_DGRAM, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        REQUIRE(connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
    }
    ~Datagrams() { close(socket_); }
    Datagrams(const Datagrams&) = delete;
    Datagrams& operator=(const Datagrams&) = delete;

    void send(std::string_view bytes) const { REQUIRE(offer(bytes)); }
    /// Sends a datagram to the robot's port, at which no program has to listen.
    /// @return whether the datagram was sent; false if no program listened when the last datagram
    /// arrived
    bool offer(std::string_view bytes) const {
        return ::send(socket_, bytes.data(), bytes.size(), 0) >= 0;
    }
    /// Next datagram received; empty if none arrives in time.
    std::string next(std::chrono::milliseconds most) const {
        const timeval longest{most.count() / 1000, most.count() % 1000 * 1000};
        setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
        char bytes[65536];
        const ssize_t got = recv(socket_, bytes, sizeof bytes, 0);
        return got < 0 ? std::string() : std::string(bytes, static_cast<std::size_t>(got));
    }

  private:
    int socket_;
};

}  // namespace rovernet::test
