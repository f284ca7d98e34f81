// SPDX-License-Identifier: MIT
#pragma once

#include "sim/message.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace rovernet {

/// Control packet of a routing protocol as it is on the air, for captures: what follows the IP
/// header.
struct PacketOnAir {
    /// Protocol number in the IP header: 17 for UDP.
    std::uint8_t ip_protocol = 17;
    /// UDP port of source and destination; none with another IP protocol.
    std::uint16_t port = 0;
    /// Bytes after the UDP header, or after the IP header.
    std::string bytes;
};
/// Header of a message as it is on the air, between the IP header and UDP.
struct HeaderOnAir {
    /// Protocol number in the IP header.
    std::uint8_t ip_protocol = 0;
    std::string bytes;
};

/// Control packet as it is on the air in `frame`; none if its protocol has no format of its own.
/// @param address  IPv4 address of a node, in host order
std::optional<PacketOnAir> packet_on_air(const Message& message, const Frame& frame,
                                         const std::function<std::uint32_t(NodeId)>& address);
/// Header of a message as it is on the air; none if the protocol has no format of its own.
std::optional<HeaderOnAir> header_on_air(const FrameHeader& header,
                                         const std::function<std::uint32_t(NodeId)>& address);

}  // namespace rovernet
