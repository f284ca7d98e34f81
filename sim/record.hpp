// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fate.hpp"
#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/message.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

namespace rovernet {

/// One receiver of one transmission.
struct Reception {
    Time time;  ///< end of the frame at this receiver
    NodeId node;
    Fate fate = Fate::waiting;
    bool delivered = false;  ///< handed to the application: the node's first copy

    /// The order in which a transmission arrives.
    friend bool operator<(const Reception& a, const Reception& b) {
        return a.time != b.time ? a.time < b.time : a.node < b.node;
    }
};

/// An application hands a message to its router.
struct Sent {
    Time time;
    NodeId node;
    MessageId message;
    Hops ttl;              ///< hops that the message may cross
    std::uint32_t robots;  ///< robots in the network now, the sender included
    /// Robots that a chain of links joins to the sender now, the sender not included; present only
    /// if a sink asks for it (see kind_reachable, kind_cheap_reachable).
    std::optional<std::uint32_t> reachable;
};

/// A node puts a frame on air.
struct Transmitted {
    Time time;
    Frame frame;
    std::optional<NodeId> heard_from;  ///< who the frame came from, if the sender forwards it
};

/// A transmission (or a part of it) arrives: receptions in order of time, then of node, after all
/// earlier records.
struct Received {
    Frame frame;
    std::span<const Reception> receptions;
    Duration reserved{0};      ///< [ns] after its end, by a unicast at csma for its acknowledgement
    std::uint32_t header = 0;  ///< [bytes] that access adds to the message
    /// [dBm] Received power of each reception; empty unless a sink asks for it (see kind_levels).
    std::span<const Dbm> levels = {};
};

/// A copy is lost while it waits.
struct Dropped {
    Time time;
    NodeId node;
    Frame frame;  ///< as received
    DropReason reason;
};

/// A node begins a new leg.
struct Moved {
    Time time;
    NodeId node;
    Leg leg;
};

/// A node has reached the end of its movement and rests.
struct Arrived {
    Time time;
    NodeId node;
};

/// A node found no way to its goal and stays where it is.
struct NoWay {
    Time time;
    NodeId node;
    Vec3 goal;  ///< [m]
};

/// From now on `to` can hear `from`. Links are ordered: the way back is a link of its own.
struct LinkUp {
    Time time;
    NodeId from;
    NodeId to;
};

/// From now on `to` cannot hear `from` any more.
struct LinkDown {
    Time time;
    NodeId from;
    NodeId to;
};

/// A node's radio is switched on or off.
struct Switched {
    Time time;
    NodeId node;
    bool on;
};

/// The MAC puts a frame on air: that of a message, told of by Transmitted too, or one that only
/// controls access.
struct AirSent {
    Time time;
    AirFrame air;
    std::uint32_t bytes;  ///< what access adds included
};

/// A frame that only controls access ends at the station that it is for.
struct ControlReceived {
    AirFrame air;
    Reception reception;  ///< fate: waiting, or why it was lost
    std::uint32_t bytes;
};

/// Everything observable. A lost packet is a record: never an exception, never a log line.
using Record = std::variant<Sent, Transmitted, Received, Dropped, Moved, Arrived, NoWay, Switched,
                            LinkUp, LinkDown, AirSent, ControlReceived>;

/// A set of record kinds, for sinks to say what they want.
using KindMask = std::uint32_t;

template <class T>
constexpr KindMask kind_of();
template <>
constexpr KindMask kind_of<Sent>() {
    return 1U << 0;
}
template <>
constexpr KindMask kind_of<Transmitted>() {
    return 1U << 1;
}
template <>
constexpr KindMask kind_of<Received>() {
    return 1U << 2;
}
template <>
constexpr KindMask kind_of<Dropped>() {
    return 1U << 3;
}
template <>
constexpr KindMask kind_of<Moved>() {
    return 1U << 4;
}
template <>
constexpr KindMask kind_of<Arrived>() {
    return 1U << 5;
}
template <>
constexpr KindMask kind_of<NoWay>() {
    return 1U << 6;
}
template <>
constexpr KindMask kind_of<Switched>() {
    return 1U << 7;
}

template <>
constexpr KindMask kind_of<LinkUp>() {
    return 1U << 8;
}
template <>
constexpr KindMask kind_of<LinkDown>() {
    return 1U << 9;
}
template <>
constexpr KindMask kind_of<AirSent>() {
    return 1U << 10;
}
template <>
constexpr KindMask kind_of<ControlReceived>() {
    return 1U << 11;
}
/// Both link records. They cost a search for link changes, which runs only if a sink asks.
inline constexpr KindMask kind_links = kind_of<LinkUp>() | kind_of<LinkDown>();

/// Not a record: asks that Sent carries `reachable`, which costs a search of the network.
inline constexpr KindMask kind_reachable = 1U << 31;
/// Not a record: as kind_reachable, as long as that is cheap (Reachability::cheap_searches).
inline constexpr KindMask kind_cheap_reachable = 1U << 30;
/// Not a record: asks that Received carries `levels`, which costs a look at each receiver.
inline constexpr KindMask kind_levels = 1U << 29;
/// All records, and nothing that costs more.
inline constexpr KindMask kind_all = 0x1fffffff;

/// What a sink may look up while it handles a record.
struct RecordContext {
    const Legs& legs;
    const MessageTable& messages;
};

}  // namespace rovernet
