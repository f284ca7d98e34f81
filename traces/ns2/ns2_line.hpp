// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/time.hpp"

#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

// One line of an ns-2 trace, as what it says. Texts are pieces of the line: valid as long as it is.

namespace rovernet {

/// Wireless trace formats of ns-2.35: of the CMU extension, of `use-newtrace`, and of
/// `use-taggedtrace`.
enum class Ns2Dialect : std::uint8_t { old_format, new_format, tagged };

/// MAC header of a packet, as the line shows it.
struct Ns2Mac {
    std::uint32_t duration_us = 0;  ///< [us] reserved after the frame
    std::uint32_t to = 0;           ///< address of the receiver; 0xffffffff: everybody
    std::uint32_t from = 0;         ///< address of the transmitter
    std::uint32_t ethertype = 0;  ///< 0x800 IP, 0x806 ARP; 0: control frame, or no MAC has seen it
    friend bool operator==(const Ns2Mac&, const Ns2Mac&) = default;
};

/// IP header of a packet.
struct Ns2Ip {
    std::int64_t from = 0;  ///< address of the origin
    std::int64_t from_port = 0;
    std::int64_t to = 0;  ///< address of the destination; negative: everybody
    std::int64_t to_port = 0;
    std::int64_t ttl = 0;
    std::int64_t next_hop = 0;  ///< 0: none, or robot 0
    friend bool operator==(const Ns2Ip&, const Ns2Ip&) = default;
};

/// A packet at one layer of one robot: a line `s`, `r`, `D`, `f` or `x`.
struct Ns2Packet {
    Ns2Dialect dialect{};
    char op = 0;  ///< s, r, f, D or x, also where the format writes d, + or h
    Time time;
    NodeId node;
    std::string_view layer;             ///< AGT, RTR, IFQ, MAC, PHY or TRP
    std::string_view reason;            ///< reason of a drop; --- if there is none, or none is told
    std::uint64_t uid = 0;              ///< not unique: all control frames have 0
    std::string_view type;              ///< such as cbr, AODV, RTS; empty if it is not told
    std::optional<std::uint64_t> size;  ///< [bytes]; nothing if it is not told
    std::optional<Ns2Mac> mac;
    std::optional<Ns2Ip> ip;       ///< nothing for ARP and for frames of the MAC's own
    std::optional<Vec3> position;  ///< [m]
    std::optional<double> energy;  ///< [J]
    std::string_view payload;      ///< all that follows the IP header
    std::int64_t flow = 0;         ///< flow id of ns-2
    int uid_column = 0;            ///< column of the uid; 0: the line has none
};

/// `M` line: a robot gets a goal.
struct Ns2Move {
    Time time;
    NodeId node;
    Vec3 from;         ///< [m]
    Vec3 to;           ///< [m], at the height of `from`
    double speed = 0;  ///< [m/s]
};

/// `N` line: the energy that a robot has left.
struct Ns2Energy {
    Time time;
    NodeId node;
    double energy = 0;  ///< [J]
};

/// Annotation of rovernet: how many robots a chain of links joined to a message's sender.
struct Ns2Reachable {
    Time time;
    std::uint64_t uid = 0;
    std::uint32_t robots = 0;
};

/// Kinds of lines that stand in traces and say nothing of a radio.
enum class Ns2Other : std::uint8_t {
    blank,
    comment,
    wired,       ///< event of a wired link, or a change of one
    nam,         ///< line for the animator
    dsr,         ///< statistics of DSR: SFf, Sconfig, ...
    annotation,  ///< `v` line that is not a Ns2Reachable
    message      ///< text that ns prints to the terminal
};
inline constexpr std::string_view names_of_other[] = {"blank", "comment",    "wired",  "nam",
                                                      "dsr",   "annotation", "message"};

/// A line that is none of ns-2.
struct Ns2Refused {
    int column = 1;
    std::string_view found;     ///< empty: the line ends there
    std::string_view expected;  ///< text that lives for ever
};

using Ns2Line = std::variant<Ns2Packet, Ns2Move, Ns2Energy, Ns2Reachable, Ns2Other, Ns2Refused>;

/// Numbers of robots are below this, so that a broken number does not eat the memory.
inline constexpr std::uint32_t most_robots = 1U << 20;

/// Port of routing agents in ns-2 (RT_PORT).
inline constexpr std::int64_t routing_port = 255;

/// Reads one line, without its end-of-line characters.
///
/// Every line is an event, skipped by its kind, or refused; none is an exception. Times are rounded
/// to 1 ns. Source: cmu-trace.cc of ns-2.35 and its output; the swapped -M:s and -M:d of the tagged
/// format are put right.
Ns2Line parse_ns2_line(std::string_view line);

}  // namespace rovernet
