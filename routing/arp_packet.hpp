// SPDX-License-Identifier: MIT
#pragma once

#include "sim/message.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

// ARP packets for IPv4 in the format of RFC 826. In the simulation an ARP packet is a Message of
// kind request_kind or reply_kind without payload, from its origin to the target Message::to.

namespace rovernet::arp {

/// EtherType of ARP packets, in the SNAP header.
inline constexpr std::uint16_t ethertype = 0x0806;
/// Kinds of ARP packets: values of Message::kind, and types of these packets in ns-2 traces.
inline constexpr std::string_view request_kind = "ARP REQUEST", reply_kind = "ARP REPLY";
/// Size of an ARP packet [bytes].
inline constexpr std::uint32_t packet_bytes = 28;

/// Addresses of a station.
struct Station {
    std::array<std::uint8_t, 6> mac{};
    /// IPv4 address, in host order.
    std::uint32_t ip = 0;
};
/// Bytes of an ARP packet on air. A request has zeros in place of the target's MAC address, which
/// the sender does not know yet.
std::string on_air(const Message& packet, const Station& sender, const Station& target);

}  // namespace rovernet::arp
