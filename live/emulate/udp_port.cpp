// SPDX-License-Identifier: MIT
#include "live/emulate/udp_port.hpp"

#include "sim/error.hpp"

#include <fmt/format.h>

#include <arpa/inet.h>
#include <cerrno>
#include <cstring>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

namespace rovernet {
namespace {

constexpr std::size_t longest_datagram = 65'536;  // [bytes]

sockaddr* as_address(sockaddr_storage& storage) { return reinterpret_cast<sockaddr*>(&storage); }

/// Writes an address as the system wants it. @return its size
socklen_t put_address(const Address& own, sockaddr_storage& storage) {
    sockaddr_in v4{};
    sockaddr_in6 v6{};
    if (inet_pton(AF_INET, own.host.c_str(), &v4.sin_addr) == 1) {
        v4.sin_family = AF_INET;
        v4.sin_port = htons(own.port);
        std::memcpy(&storage, &v4, sizeof v4);
        return sizeof v4;
    }
    inet_pton(AF_INET6, own.host.c_str(), &v6.sin6_addr);
    v6.sin6_family = AF_INET6;
    v6.sin6_port = htons(own.port);
    std::memcpy(&storage, &v6, sizeof v6);
    return sizeof v6;
}

/// Port of a socket's own address.
std::uint16_t port_of(int socket) {
    sockaddr_storage storage{};
    socklen_t size = sizeof storage;
    getsockname(socket, as_address(storage), &size);
    sockaddr_in found{};  // the port is at the same place in an address of IPv6
    std::memcpy(&found, &storage, sizeof found);
    return ntohs(found.sin_port);
}

}  // namespace

UdpPort::UdpPort(const Address& own, std::string robot) : robot_(std::move(robot)) {
    sockaddr_storage address{};
    const socklen_t size = put_address(own, address);
    socket_ = socket(address.ss_family, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (socket_ < 0 || bind(socket_, as_address(address), size) != 0) {
        const std::string why = std::strerror(errno);
        if (socket_ >= 0) ::close(socket_);
        throw RunError(fmt::format("cannot listen on {} (robot {}): {}", own.text(), robot_, why));
    }
    where_ = {own.host, port_of(socket_)};
}

UdpPort::~UdpPort() { ::close(socket_); }

std::string UdpPort::text() const { return fmt::format("{} (robot {})", where_.text(), robot_); }

bool UdpPort::read(const std::function<void(std::string_view)>& take) {
    char bytes[longest_datagram];
    sockaddr_storage from{};
    socklen_t size = sizeof from;
    const ssize_t got = recvfrom(socket_, bytes, sizeof bytes, 0, as_address(from), &size);
    if (got < 0) return true;  // none is there, or the last packet found nobody
    peer_ = from;
    peer_size_ = size;
    take({bytes, static_cast<std::size_t>(got)});
    return true;
}

void UdpPort::write(std::string_view packet) {
    if (peer_size_ == 0) return;
    (void)!sendto(socket_, packet.data(), packet.size(), 0, as_address(peer_), peer_size_);
}

}  // namespace rovernet
