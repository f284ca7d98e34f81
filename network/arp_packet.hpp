// SPDX-License-Identifier: MIT
#pragma once

#include "sim/message.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

// ARP packets for IPv4 in the format of RFC 826. In the simulation an ARP packet is a Message with
// one of these kinds and no payload: its origin is the sender, Message::to the target.

namespace rovernet::arp {

/// Type of the packets behind LLC and SNAP.
inline constexpr std::uint16_t ethertype = 0x0806;
/// Kinds of packets: the type in ns-2 traces, and the name.
inline constexpr std::string_view request_kind = "ARP REQUEST", reply_kind = "ARP REPLY";
/// Size of a packet [bytes].
inline constexpr std::uint32_t packet_bytes = 28;

/// Addresses of a station.
struct Station {
    std::array<std::uint8_t, 6> mac{};
    /// IPv4 address, in host order.
    std::uint32_t ip = 0;
};
/// Bytes of a packet as they are on the air. A request has zeros for the MAC of its target, which
/// it asks for.
std::string on_air(const Message& packet, const Station& sender, const Station& target);

}  // namespace rovernet::arp
