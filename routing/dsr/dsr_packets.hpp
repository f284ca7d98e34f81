// SPDX-License-Identifier: MIT
#pragma once

#include "routing/dsr/dsr_path.hpp"
#include "sim/ids.hpp"
#include "sim/message.hpp"
#include "sim/routing_protocol.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

// Control packets of DSR in the formats of RFC 4728, section 6, big-endian: the DSR Options header,
// which follows the IP header. An address is the id of a node. If an option leaves out an end of
// its route, this end is the origin or the destination of the packet: Message::origin, Message::to.

namespace rovernet::dsr {

/// IP protocol number of the packets (RFC 4728, section 11).
inline constexpr std::uint8_t ip_protocol = 48;
/// Kinds of DSR packets (Message::kind): the type in ns-2 traces, then the name of the packet.
inline constexpr std::string_view request_kind = "DSR REQUEST", reply_kind = "DSR REPLY",
                                  error_kind = "DSR ERROR";
/// Protocol of the header of a message (FrameHeader::protocol), the first word of the kinds above.
inline constexpr std::string_view protocol = "DSR";
/// Size of an IP header, and of the fixed part of the DSR Options header (RFC 4728, 6.1) [bytes].
inline constexpr std::uint32_t ip_header = 20, fixed_header = 4;
/// Size of a Source Route option with this number of addresses (RFC 4728, 6.7) [bytes].
constexpr std::uint32_t route_option(std::size_t addresses) {
    return 4 + 4 * static_cast<std::uint32_t>(addresses);
}

/// Route Request option (RFC 4728, 6.2).
struct Request {
    std::uint16_t id = 0;
    NodeId target;
    /// Path of the request so far: originator, which the option itself does not contain, and the
    /// nodes that forwarded the request.
    Path path;
};
/// Route Reply option (RFC 4728, 6.3).
struct Reply {
    /// Route that answers the request: from the originator, which the option itself does not
    /// contain, to the target.
    Path path;
};
/// Route Error option of type NODE_UNREACHABLE (RFC 4728, 6.4).
struct Error {
    /// Node that could not reach its next hop, and node to which the error is reported.
    NodeId from, to;
    NodeId unreachable;
    /// Number of times that the lost packet had been salvaged (sent along another route).
    std::uint8_t salvage = 0;
};
/// Options of a DSR packet; each is empty if the packet does not contain the option.
struct Packet {
    std::optional<Request> request = std::nullopt;
    std::optional<Reply> reply = std::nullopt;
    std::optional<Error> error = std::nullopt;
    /// Source Route option (RFC 4728, 6.7) from the packet's origin to its destination.
    std::optional<Path> route = std::nullopt;
};

/// Bytes of the DSR Options header with the options of a packet.
std::string to_bytes(const Packet& packet);
/// Bytes of the DSR Options header before a message. The header has a Source Route option, and the
/// IP protocol number of UDP, which follows it. The route of a salvaged message also lists its
/// first node, because this node is not the message's source (RFC 4728, 8.3.6).
/// @param salvage  number of times that the message was salvaged (sent along another route)
/// @param hop      number of hops that the message has made on this path
std::string message_header(const Path& path, unsigned salvage, std::size_t hop);
/// Packet that the payload of a message contains; without options if the payload is no DSR packet.
Packet packet_of(const Message& message);

/// Bytes of a packet as transmitted in `frame`: with IP addresses in place of the ids of nodes, and
/// with the segments left at the frame's hop.
/// @param address  IPv4 address of a node, in host byte order
std::string on_air(std::string_view bytes, const Frame& frame,
                   const std::function<std::uint32_t(NodeId)>& address);

/// Bytes of the DSR Options header of a message as transmitted: with IP addresses in place of the
/// ids of nodes.
/// @param address  IPv4 address of a node, in host byte order
std::string header_on_air(std::string_view bytes,
                          const std::function<std::uint32_t(NodeId)>& address);

/// Appends the content of a packet to `text`, as ns-2 writes it. For a reply, the number of the
/// answered request is written as 0, because a reply of RFC 4728 does not contain the number.
void describe(const Message& message, PacketStyle style, std::string& text);

}  // namespace rovernet::dsr
