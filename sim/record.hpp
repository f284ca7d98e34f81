// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fate.hpp"
#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/message.hpp"
#include "sim/record_kind.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

// Records: everything that can be observed of a run. The parts of a network give them to
// World::emit; traces, metrics, the fingerprint and the user's own sinks see records and nothing
// else. They come in order of time. A record and what it points to is good while a sink handles it.
//
//     void on(const Record& record, const RecordContext& context) {
//         const auto* got = std::get_if<Received>(&record);
//         if (!got) return;
//         const Message& message = context.messages[got->frame.message];
//         for (const Reception& at : got->receptions) count(message.flow, at.fate);
//     }

namespace rovernet {

/// Reception of one transmission at one receiver that could decode it if nothing interfered.
/// Medium::find_receivers fixes node and time when the frame goes on air, whatever moves later;
/// reception model and routing protocol fill in the rest when it ends.
struct Reception {
    /// End of the frame at this receiver.
    Time time;
    NodeId node;
    /// Fate of the copy here.
    Fate fate = Fate::waiting;
    /// The application gets the message: it is the node's first copy, and for this node.
    bool delivered = false;
    /// The receiver began to receive the frame. Of a lost frame `sinr` says whether it did.
    bool locked = true;

    /// Order in which the receptions of a transmission are served: by time, then by node.
    friend bool operator<(const Reception& a, const Reception& b) {
        return a.time != b.time ? a.time < b.time : a.node < b.node;
    }
};

/// An application hands a message to the routing protocol, or to the MAC if it goes over one hop.
/// Packets of a protocol's own have no Sent. Applications emit it before anything comes of the
/// message.
struct Sent {
    Time time;
    NodeId node;
    MessageId message;
    /// Hops that the message may cross.
    Hops ttl;
    /// Robots that the message concerns, the sender included: all that are there now; 2 for a
    /// unicast.
    std::uint32_t robots;
    /// Robots of these that a chain of links joins to the sender now, the sender not included;
    /// present only if a sink asks for it (see kind_reachable, kind_cheap_reachable). It bounds
    /// what any protocol could reach if nothing moved.
    std::optional<std::uint32_t> reachable;
};

/// A node puts a frame of a message on air. A frame that csma repeats has one for each attempt. The
/// MAC emits it as the frame begins; how long it lasts shows at its receivers.
struct Transmitted {
    Time time;
    Frame frame;
    /// Node that the frame came from, if the sender forwards it.
    std::optional<NodeId> heard_from;
};

/// A frame of a message ends at some of its receivers: a broadcast at all of them at once, or in
/// several records if other events lie between; a unicast at the node that it is for. Routing emits
/// it when the protocol has said what becomes of each copy, and before applications react.
struct Received {
    Frame frame;
    /// Receptions in order of time, then of node, later than all earlier records.
    std::span<const Reception> receptions;
    /// Time [ns] that a unicast at csma reserves after its end, for its acknowledgement.
    Duration reserved{0};
    /// Bytes that the access model adds to the message.
    std::uint32_t header = 0;
    /// Received power [dBm] of each reception; empty unless a sink asks for it (see kind_levels).
    std::span<const Dbm> levels = {};
};

/// A node loses a copy other than in a reception: while it waits there, or before it is on its way.
/// With the fates of Received it accounts for every copy that goes no further.
struct Dropped {
    Time time;
    NodeId node;
    /// Frame as the node received it. A frame that the access model gives up is as it was to be
    /// sent.
    Frame frame;
    /// Reason for which it is lost.
    DropReason reason;
};

/// A node begins a new leg: where it is from `time` on. The first one is that of the begin of the
/// run, or of the time at which the robot is added. A robot that is switched off or on, or put
/// elsewhere, has one as well.
struct Moved {
    Time time;
    NodeId node;
    /// Leg that begins at `time`.
    Leg leg;
};

/// A node has reached the end of its movement and rests until it is given another. Motion emits it
/// when the movement model answers AtRest.
struct Arrived {
    Time time;
    NodeId node;
};

/// A node found no way around the walls to its goal, and stays where it is. Motion emits it when
/// the movement model answers Blocked.
struct NoWay {
    Time time;
    NodeId node;
    /// Goal that could not be reached [m].
    Vec3 goal;
};

/// From now on `to` can hear `from`. Links are ordered: the way back is a link of its own.
/// LinkMonitor emits both records of links, at the instant of the change, if a sink wants them.
struct LinkUp {
    Time time;
    /// Robot that is heard.
    NodeId from;
    /// Robot that hears.
    NodeId to;
};

/// From now on `to` cannot hear `from` any more.
struct LinkDown {
    Time time;
    NodeId from;
    NodeId to;
};

/// A node's radio is switched on or off. Robots are on when they are added, without a record.
/// Engine::switch_robot emits it, before anything that follows from it.
struct Switched {
    Time time;
    NodeId node;
    /// State from now on.
    bool on;
};

/// The MAC puts a frame on air: that of a message, for which Transmitted comes just before, or a
/// control frame. It tells what a monitor of the channel would see.
struct AirSent {
    Time time;
    /// Frame as it is on air.
    AirFrame air;
    /// Size [bytes], what the access model adds included.
    std::uint32_t bytes;
};

/// A control frame ends at the station that it is for, if that is on. Others that overhear it have
/// no record.
struct ControlReceived {
    AirFrame air;
    /// Its end; its fate is `waiting` if the station has it, else why it was lost.
    Reception reception;
    /// Size [bytes].
    std::uint32_t bytes;
};

/// Any record. A lost packet is a record: never an exception, never a line in a log.
using Record = std::variant<Sent, Transmitted, Received, Dropped, Moved, Arrived, NoWay, Switched,
                            LinkUp, LinkDown, AirSent, ControlReceived>;

/// State of the network that a sink may look up while it handles a record.
struct RecordContext {
    /// Legs of all robots, as they are now.
    const Legs& legs;
    /// Messages that a frame or a copy still refers to: those of the record are among them.
    const MessageTable& messages;
};

}  // namespace rovernet
