// SPDX-License-Identifier: MIT
#pragma once

#include "sim/error.hpp"
#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/record.hpp"
#include "sim/time.hpp"

#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

namespace rovernet {

/// Packet line of an ns-2 trace, in either format: what it tells of a robot's message.
struct Ns2Packet {
    enum class Event : std::uint8_t {
        sent,          ///< `s AGT`
        own,           ///< `r RTR` of the own packet on its way down
        transmitted,   ///< `s RTR`, `f RTR`
        received,      ///< `r RTR`
        delivered,     ///< `r AGT`
        ended_by_ttl,  ///< `D RTR TTL`
        suppressed,    ///< `D RTR DUP`
        dropped,       ///< `D` with layer and code of a DropReason
        lost           ///< `D MAC` with the reason: SLP, ERR, COL, BSY or DUP
    };
    Event event{};
    Fate loss = Fate::off;              ///< fate of a copy that is lost in a reception
    DropReason drop = DropReason::off;  ///< reason for which a copy is dropped
    Time time;
    NodeId node;
    std::optional<NodeId> heard_from;  ///< the last hop, once a MAC has seen the packet
    NodeId origin;
    std::uint64_t uid = 0;
    std::uint32_t size = 0;  ///< [bytes]
    std::uint16_t ttl = 0;
    bool for_one = false;  ///< the line names its destination
    int uid_column = 0;
    int ttl_column = 0;
};

/// An `M` line.
struct Ns2Move {
    Time time;
    NodeId node;
    Vec3 from;         ///< [m]
    Vec3 to;           ///< [m], at the height of `from`
    double speed = 0;  ///< [m/s]
};

/// Our annotation: how many robots a chain of links joined to a message's sender.
struct Ns2Reachable {
    std::uint64_t uid = 0;
    std::uint32_t robots = 0;
};

/// Content of a line; nothing (monostate) for one that ns-2 writes but a Ns2Trace does not.
using Ns2Line = std::variant<std::monostate, Ns2Packet, Ns2Move, Ns2Reachable>;

/// Numbers of robots are below this, so that a broken number does not eat the memory.
inline constexpr std::uint32_t most_robots = 1U << 20;

/// Reads one line, without its end-of-line characters.
/// @param  where  file and line, for the error
/// @throws InputError if it is no line of ns-2
Ns2Line parse_ns2_line(std::string_view line, const Location& where);

}  // namespace rovernet
