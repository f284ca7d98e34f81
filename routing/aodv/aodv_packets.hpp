// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/message.hpp"
#include "sim/routing_protocol.hpp"
#include "sim/time.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

// Control packets of AODV in the formats of RFC 3561, section 5, big-endian. An address is the id
// of a node. A packet is one Message on all its hops, because its bytes do not change on the way:
// the hop count at a hop is the count in the bytes plus the number of earlier hops of the frame.

namespace rovernet::aodv {

/// UDP port of the packets (RFC 3561, section 11).
inline constexpr std::uint16_t port = 654;
/// Kinds of AODV packets, see Message::kind: type in ns-2 traces, and name.
inline constexpr std::string_view request_kind = "AODV REQUEST", reply_kind = "AODV REPLY",
                                  error_kind = "AODV ERROR", hello_kind = "AODV HELLO";

/// Route request, RREQ (5.1).
struct Request {
    /// Flag G: a node that answers in place of the destination also sends the destination the route
    /// to the originator (gratuitous reply, 6.6.3).
    bool gratuitous = false;
    /// Flag D: only the destination may answer.
    bool destination_only = false;
    /// RREQ ID: number of the request among the requests of its originator.
    std::uint32_t id = 0;
    NodeId destination;
    /// Last known sequence number of the destination; empty (flag U) if unknown.
    std::optional<std::uint32_t> number;
    NodeId originator;
    std::uint32_t originator_number = 0;
};

/// Route reply, RREP, and HELLO (5.2).
struct Reply {
    /// Hops from the node that answers to the destination.
    std::uint8_t hops = 0;
    NodeId destination;
    std::uint32_t number = 0;
    /// Originator of the request that the reply answers.
    NodeId originator;
    /// Lifetime of the route [ns]; the packet has whole milliseconds.
    Duration lifetime{0};
};

/// Route error, RERR (5.3).
struct Error {
    /// Flag N: the route was repaired and is longer now; receivers keep their routes.
    bool is_repaired = false;
    /// Destination that cannot be reached, and its sequence number; 0 if the number is unknown.
    struct Lost {
        NodeId destination;
        std::uint32_t number = 0;
    };
    std::vector<Lost> lost;
};

/// Bytes of a packet: 24 for a Request, 20 for a Reply, 4 + 8 per lost destination for an Error.
std::string to_bytes(const Request& request);
std::string to_bytes(const Reply& reply);
std::string to_bytes(const Error& error);

using Packet = std::variant<std::monostate, Request, Reply, Error>;
/// Packet that `bytes` contain; std::monostate if `bytes` are no AODV packet.
Packet packet_of(std::string_view bytes);

/// Bytes of a packet as transmitted in `frame`: with IP addresses in place of the ids of nodes, and
/// with the hop count of the frame's hop.
/// @param address  IPv4 address of a node, in host byte order
std::string on_air(std::string_view bytes, const Frame& frame,
                   const std::function<std::uint32_t(NodeId)>& address);

/// Appends the content of a packet to `text`, as ns-2 writes it.
void describe(const Message& message, const Frame& frame, PacketStyle style, std::string& text);

}  // namespace rovernet::aodv
