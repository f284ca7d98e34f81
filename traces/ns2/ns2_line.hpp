// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/time.hpp"

#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

// Parsed line of an ns-2 trace. Texts refer to the line's characters, which must outlive them.

namespace rovernet {

/// Wireless trace formats of ns-2.35: the CMU extension's, `use-newtrace`, and `use-taggedtrace`.
enum class Ns2Dialect : std::uint8_t { old_format, new_format, tagged };

/// MAC header of a packet, as in the line.
struct Ns2Mac {
    std::uint32_t duration_us = 0;  ///< time reserved after the frame [us]
    std::uint32_t to = 0;           ///< address of the receiver; 0xffffffff: broadcast
    std::uint32_t from = 0;         ///< address of the transmitter
    std::uint32_t ethertype = 0;    ///< 0x800 IP, 0x806 ARP; 0: control frame, or not yet at a MAC
    bool is_smac = false;           ///< the header is of S-MAC, which has no ethertype

    /// Whether a MAC has sent the packet. Before a MAC sends a packet, both addresses are 0.
    bool has_sent() const { return ethertype != 0 || (is_smac && (to != 0 || from != 0)); }
    /// Equality of all fields except is_smac.
    friend bool operator==(const Ns2Mac& a, const Ns2Mac& b) {
        return a.duration_us == b.duration_us && a.to == b.to && a.from == b.from &&
               a.ethertype == b.ethertype;
    }
};

/// IP header of a packet.
struct Ns2Ip {
    std::int64_t from = 0;  ///< address of the packet's origin
    std::int64_t from_port = 0;
    std::int64_t to = 0;  ///< address of the destination; negative: broadcast
    std::int64_t to_port = 0;
    std::int64_t ttl = 0;
    std::int64_t next_hop = 0;  ///< address of the next hop; 0: none, or robot 0
    friend bool operator==(const Ns2Ip&, const Ns2Ip&) = default;
};

/// Packet at one layer of one robot: a line `s`, `r`, `D`, `f` or `x`.
struct Ns2Packet {
    Ns2Dialect dialect{};
    char op = 0;  ///< event: s, r, f, D or x, also if the format writes d, + or h
    Time time;
    NodeId node;
    std::string_view layer;             ///< layer: AGT, RTR, IFQ, MAC, PHY or TRP
    std::string_view reason;            ///< reason of a drop; --- if there is none
    std::uint64_t uid = 0;              ///< id, not unique: all control frames have 0
    std::string_view type;              ///< type, such as cbr, AODV, RTS; empty if not in the line
    std::optional<std::uint64_t> size;  ///< size [bytes]; empty if not in the line
    std::optional<Ns2Mac> mac;
    std::optional<Ns2Ip> ip;       ///< IP header; empty for ARP and for control frames of the MAC
    std::optional<Vec3> position;  ///< position of the robot [m]
    std::optional<double> energy;  ///< remaining energy of the robot [J]
    std::string_view payload;      ///< text after the IP header
    std::int64_t flow = 0;         ///< flow id of ns-2
    int uid_column = 0;            ///< column of the uid in the line; 0: not in the line
};

/// `M` line: a robot gets a new goal.
struct Ns2Move {
    Time time;
    NodeId node;
    Vec3 from;         ///< current position of the robot [m]
    Vec3 to;           ///< goal [m], at the height of `from`
    double speed = 0;  ///< speed of the robot [m/s]
};

/// `N` line: remaining energy of a robot.
struct Ns2Energy {
    Time time;
    NodeId node;
    double energy = 0;  ///< remaining energy of the robot [J]
};

/// Annotation of rovernet: number of robots that a chain of links connected to a message's sender.
struct Ns2Reachable {
    Time time;
    std::uint64_t uid = 0;
    std::uint32_t robots = 0;
};

/// Kinds of lines in traces that have no information about radio.
enum class Ns2Other : std::uint8_t {
    blank,
    comment,
    wired,       ///< event or change of a wired link
    nam,         ///< line for the network animator
    dsr,         ///< statistics of DSR: SFf, Sconfig, ...
    annotation,  ///< `v` line that is not an Ns2Reachable
    message,     ///< text that ns prints to the terminal
    header       ///< `M` line with the options of the simulation script: names and values
};
inline constexpr std::string_view names_of_other[] = {"blank", "comment",    "wired",   "nam",
                                                      "dsr",   "annotation", "message", "header"};

/// Line that is not an ns-2 trace line.
struct Ns2Refused {
    int column = 1;
    std::string_view found;     ///< text found; empty: end of the line
    std::string_view expected;  ///< text expected, with static lifetime
};

using Ns2Line = std::variant<Ns2Packet, Ns2Move, Ns2Energy, Ns2Reachable, Ns2Other, Ns2Refused>;

/// Limit for numbers of robots, so that a wrong number does not use up the memory.
inline constexpr std::uint32_t most_robots = 1U << 20;

/// Port of routing agents in ns-2 (RT_PORT).
inline constexpr std::int64_t routing_port = 255;

/// Parses one line, without its end-of-line characters.
///
/// The result is an event, a kind of line to skip (Ns2Other), or an error (Ns2Refused). No line
/// causes an exception. Times are rounded to 1 ns. Source: cmu-trace.cc of ns-2.35 and its output;
/// the swapped -M:s and -M:d of the tagged format are corrected.
Ns2Line parse_ns2_line(std::string_view line);

}  // namespace rovernet
