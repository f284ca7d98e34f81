// SPDX-License-Identifier: MIT
#pragma once

#include "sim/message.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace rovernet {

/// Control packet of a routing protocol as transmitted, for packet captures: the part after the IP
/// header.
struct PacketOnAir {
    /// Protocol number in the IP header: 17 for UDP.
    std::uint8_t ip_protocol = 17;
    /// UDP port of source and destination; not used with another IP protocol than UDP.
    std::uint16_t port = 0;
    /// Bytes after the UDP header; with another IP protocol, bytes after the IP header.
    std::string bytes;
};
/// Header of a message as it is on the air, between the IP header and UDP.
struct HeaderOnAir {
    /// Protocol number in the IP header.
    std::uint8_t ip_protocol = 0;
    std::string bytes;
};

/// Control packet `message` as transmitted in `frame`; empty if the packet's routing protocol has
/// no packet format.
/// @param address  IPv4 address of a node, in host byte order
std::optional<PacketOnAir> packet_on_air(const Message& message, const Frame& frame,
                                         const std::function<std::uint32_t(NodeId)>& address);
/// Header of a message as it is on the air; none if the protocol has no format of its own.
std::optional<HeaderOnAir> header_on_air(const FrameHeader& header,
                                         const std::function<std::uint32_t(NodeId)>& address);

}  // namespace rovernet
