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
// of a node. The hop count of a packet on its way is that of its bytes and the hops of its frame
// before this one, so that a packet is one Message on all its hops.

namespace rovernet::aodv {

/// UDP port of the packets (RFC 3561, section 11).
inline constexpr std::uint16_t port = 654;
/// Kinds of packets: the type in ns-2 traces, and the name.
inline constexpr std::string_view request_kind = "AODV REQUEST", reply_kind = "AODV REPLY",
                                  error_kind = "AODV ERROR", hello_kind = "AODV HELLO";

/// Route request, RREQ (5.1).
struct Request {
    /// Flag G: who answers in place of the destination tells it the way back (6.6.3).
    bool gratuitous = false;
    /// Flag D: only the destination may answer.
    bool destination_only = false;
    /// Number of the request among those of its originator.
    std::uint32_t id = 0;
    NodeId destination;
    /// Last known number of the destination; none: flag U.
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
    /// Node that asked.
    NodeId originator;
    /// Lifetime of the route, in whole milliseconds.
    Duration lifetime{0};
};

/// Route error, RERR (5.3).
struct Error {
    /// Flag N: the route was repaired, and is longer now; the routes remain.
    bool is_repaired = false;
    /// Destination that cannot be reached, and its number; 0 if that is not known.
    struct Lost {
        NodeId destination;
        std::uint32_t number = 0;
    };
    std::vector<Lost> lost;
};

/// Bytes of a packet: 24, 20, or 4 + 8 for each lost destination.
std::string to_bytes(const Request& request);
std::string to_bytes(const Reply& reply);
std::string to_bytes(const Error& error);

using Packet = std::variant<std::monostate, Request, Reply, Error>;
/// Packet in these bytes; std::monostate if they are none.
Packet packet_of(std::string_view bytes);

/// Bytes of a packet as they are on the air: with IP addresses in place of the ids of nodes, and
/// the hop count of that hop.
/// @param address  IPv4 address of a node, in host order
std::string on_air(std::string_view bytes, const Frame& frame,
                   const std::function<std::uint32_t(NodeId)>& address);

/// Appends the content of a packet to `text`, as ns-2 writes it.
void describe(const Message& message, const Frame& frame, PacketStyle style, std::string& text);

}  // namespace rovernet::aodv
