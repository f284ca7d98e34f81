// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fate.hpp"
#include "sim/ids.hpp"
#include "sim/message.hpp"
#include "sim/record_field.hpp"
#include "sim/record_kind.hpp"
#include "sim/robot_record.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

// Records: all observable events of a run. The parts of a network pass them to World::emit; traces,
// metrics, the fingerprint and user-defined sinks receive only records. Records are in order of
// time. A record, and data that it points to, is valid while a sink handles it.
//
//     void on(const Record& record, const RecordContext& context) {
//         const auto* got = std::get_if<Received>(&record);
//         if (!got) return;
//         const Message& message = context.messages[got->frame.message];
//         for (const Reception& at : got->receptions) count(message.flow, at.fate);
//     }

namespace rovernet {

class Legs;
class Router;

/// Record that an application passes a message to the routing protocol, or to the MAC if it is sent
/// over one hop; not for control packets. Applications emit it before other records of the message.
struct Sent {
    Time time;
    NodeId node;
    MessageId message;
    /// Largest number of hops that the message may travel.
    Hops ttl;
    /// Number of robots that the message concerns: 2 for a unicast, for a broadcast all robots now.
    std::uint32_t robots;
    /// Number of other robots that a chain of links connects to the sender now. Set only if a sink
    /// requests it (see kind_reachable, kind_cheap_reachable).
    std::optional<std::uint32_t> reachable;
    /// Hops of the shortest chain of links to the destination of a unicast now; none if there is no
    /// chain. Set only if a sink requests it (see kind_shortest).
    std::optional<std::uint32_t> shortest = std::nullopt;

    static constexpr std::string_view name = "Sent";
    static constexpr auto fields() {
        return describe(field("time", &Sent::time), field("node", &Sent::node),
                        field<with_origin>("message", &Sent::message), field("ttl", &Sent::ttl),
                        field("robots", &Sent::robots),
                        field<not_hashed>("reachable", &Sent::reachable),
                        field<not_hashed | since(3)>("shortest", &Sent::shortest));
    }
};

/// Record that a node starts to transmit a frame of a message. A frame that csma retransmits has a
/// record for each attempt. The MAC emits the record; Received has the end of the frame.
struct Transmitted {
    Time time;
    Frame frame;
    /// Node from which the sender received the frame, if the sender forwards it.
    std::optional<NodeId> heard_from;

    static constexpr std::string_view name = "Transmitted";
    static constexpr auto fields() {
        return describe(field("time", &Transmitted::time), field("frame", &Transmitted::frame),
                        field("heard_from", &Transmitted::heard_from));
    }
};

/// Record that a frame of a message ends at its receivers: a unicast at its destination, a
/// broadcast at all receivers, in several records if other events lie between. Routing emits it
/// after the protocol has set the fate of each copy, before applications react.
struct Received {
    Frame frame;
    /// Receptions in order of time, then of node; all are later than in earlier records.
    std::span<const Reception> receptions;
    /// Time [ns] that a unicast under csma reserves after its end, for the acknowledgement.
    Duration reserved{0};
    /// Bytes that the access model adds to the message.
    std::uint32_t header = 0;
    /// Received power [dBm] of each reception; empty unless a sink wants kind_levels.
    std::span<const Dbm> levels = {};

    static constexpr std::string_view name = "Received";
    static constexpr auto fields() {
        return describe(field("frame", &Received::frame),
                        field<not_hashed>("reserved", &Received::reserved),
                        field<not_hashed>("header", &Received::header),
                        field("receptions", &Received::receptions),
                        field<not_hashed | not_recorded>("levels", &Received::levels));
    }
};

/// Record that a routing protocol passes a unicast frame to the MAC, once for each hop. A broadcast
/// only has Transmitted, with the same data.
struct Routed {
    Time time;
    Frame frame;
    /// Node from which the sender received the frame, if the sender forwards it.
    std::optional<NodeId> heard_from;

    static constexpr std::string_view name = "Routed";
    static constexpr auto fields() {
        return describe(field("time", &Routed::time), field("frame", &Routed::frame),
                        field("heard_from", &Routed::heard_from));
    }
};

/// Record that a node loses a copy outside a reception: while the copy waits, or before its
/// transmission. Dropped and the fates of Received together cover every copy that is lost or not
/// forwarded.
struct Dropped {
    Time time;
    NodeId node;
    /// Frame as received. If the access model drops the frame: as prepared for transmission.
    Frame frame;
    DropReason reason;  ///< reason for the loss
    /// Code of the reason, a literal, if `reason` is DropReason::own.
    std::string_view own_code = {};
    /// True if only one attempt at a link was lost: the routing protocol was notified, and sends
    /// the packet again or drops it by another record. Such a record is not counted as a loss.
    bool protocol_decides = false;

    /// Code and layer of the reason for the loss.
    LossReason loss() const {
        const LossReason listed = reason_of(reason);
        return reason == DropReason::own ? LossReason{own_code, listed.layer} : listed;
    }

    static constexpr std::string_view name = "Dropped";
    static constexpr auto fields() {
        return describe(
            field("time", &Dropped::time), field("node", &Dropped::node),
            field("frame", &Dropped::frame), field("reason", &Dropped::reason),
            field<not_visited>("own_code", &Dropped::own_code),
            field<not_hashed | since(2)>("protocol_decides", &Dropped::protocol_decides));
    }
};

/// Record that the MAC starts to transmit a frame: a data frame, directly after its Transmitted
/// record, or a control frame. A monitor of the channel would capture the same frames.
struct AirSent {
    Time time;
    AirFrame air;              ///< data frame or control frame
    std::uint32_t bytes;       ///< size [bytes], including the bytes that the access model adds
    std::uint32_t header = 0;  ///< bytes that the access model adds to a frame of a message
    Duration airtime{0};       ///< airtime of the frame [ns]
    BitRate rate{0};           ///< bit rate of the payload [bit/s]
    std::uint32_t queue = 0;   ///< frames in the sender's queue, with the one that it sends

    static constexpr std::string_view name = "AirSent";
    static constexpr auto fields() {
        return describe(
            field("time", &AirSent::time), field("air", &AirSent::air),
            field("bytes", &AirSent::bytes), field<since(2)>("header", &AirSent::header),
            field<since(3)>("airtime", &AirSent::airtime), field<since(4)>("rate", &AirSent::rate),
            field<since(4)>("queue", &AirSent::queue));
    }
};

/// Record that a control frame ends at its destination, if the destination is on. Other stations
/// that overhear the frame have no record.
struct ControlReceived {
    AirFrame air;
    /// Reception at the destination; its fate is `waiting` if decoded, else the reason of the loss.
    Reception reception;
    std::uint32_t bytes;  ///< size of the control frame [bytes]

    static constexpr std::string_view name = "ControlReceived";
    static constexpr auto fields() {
        return describe(field("air", &ControlReceived::air),
                        field("reception", &ControlReceived::reception),
                        field("bytes", &ControlReceived::bytes));
    }
};

template <class... R>
std::variant<R...> variant_of(RecordList<R...>);
/// Any record. A lost packet is a record: never an exception, never a line in a log.
using Record = decltype(variant_of(RecordKinds{}));

/// State of the network that a sink may read while it handles a record.
struct RecordContext {
    const Legs& legs;              ///< current legs of all robots
    const MessageTable& messages;  ///< messages in use, including those of the record
    /// Routing protocol, which describes its control packets; null without one, and for records
    /// that were read from a file.
    const Router* router = nullptr;
    /// Header of the frame of an AirSent from a file; null: none. In a run: Router::header_bytes.
    const FrameHeader* header = nullptr;
};

}  // namespace rovernet
