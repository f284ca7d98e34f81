// SPDX-License-Identifier: MIT
#include "routing/arp_packet.hpp"

#include "routing/big_endian.hpp"

namespace rovernet::arp {
namespace {

using big_endian::put;

void put_station(std::string& to, const Station& station) {
    for (const std::uint8_t byte : station.mac) put(to, byte, 1);
    put(to, station.ip);
}

}  // namespace

std::string on_air(const Message& packet, const Station& sender, const Station& target) {
    constexpr std::uint32_t ethernet = 1, ipv4 = 0x0800, request = 1, reply = 2;
    const bool is_request = packet.kind == request_kind;
    std::string bytes;
    put(bytes, ethernet, 2);
    put(bytes, ipv4, 2);
    put(bytes, 6, 1);  // bytes of a MAC address
    put(bytes, 4, 1);  // bytes of an IP address
    put(bytes, is_request ? request : reply, 2);
    put_station(bytes, sender);
    put_station(bytes, is_request ? Station{.ip = target.ip} : target);
    return bytes;
}

}  // namespace rovernet::arp
