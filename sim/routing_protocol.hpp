// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/link_layer.hpp"
#include "sim/message.hpp"
#include "sim/record.hpp"
#include "sim/time.hpp"

#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Interface of routing protocols. A protocol is a plain struct that satisfies RouterProtocol; the
// handle Router stores it by value. Complete example: examples/router.cpp.
//
//     struct Once {
//         Hops initial_ttl() const { return 1; }
//         void send(LinkLayer& link, NodeId node, MessageId message) {
//             link.send({.message = message, .sender = node, .ttl = 1, .hops = 1}, {}, link.now());
//         }
//         void on_receive(LinkLayer&, const Frame&, std::span<Reception> receptions) {
//             for (Reception& r : receptions) { r.fate = Fate::ttl; r.delivered = true; }
//         }
//     };
//     network.route(Once{});

namespace rovernet {

/// Routing protocol. One object serves all nodes. The network calls the functions of the protocol,
/// and these functions call the network by the LinkLayer.
///
/// Sending does not call the protocol back: frames that a function of the protocol sends leave
/// after the function has returned. Rules for the functions of a protocol:
///
/// - One call of on_receive has the receptions of a frame at several nodes, which end at different
///   times. Use the state of each reception's node, and Reception::time: link.now() is the time of
///   the last reception.
/// - on_receive sets Reception::delivered only once for each message and destination, although a
///   copy that was sent again arrives twice.
/// - A `const Message&` from the link layer is valid until the next LinkLayer::originate(), which a
///   called function may also call.
/// - Message::to of a control packet is only a label. Frame::next_hop determines the receivers.
/// - A protocol that stores a MessageId or Frame after its function has returned must call
///   LinkLayer::hold(), and LinkLayer::release() when it no longer needs the MessageId or Frame.
template <class T>
concept RouterProtocol = requires(T router, LinkLayer& link, NodeId node, MessageId message,
                                  const Frame& frame, std::span<Reception> receptions) {
    /// Called for a message that the node's application sends, to message.to or to everyone.
    {router.send(link, node, message)};
    /// Called when nodes have decoded a frame that is addressed to them. The receptions are in
    /// order of time, then of node. on_receive sets Reception::fate of each, and
    /// Reception::delivered if the node's application gets the message.
    {router.on_receive(link, frame, receptions)};
    /// Initial TTL [hops] of messages of this protocol, for records.
    { std::as_const(router).initial_ttl() } -> std::convertible_to<Hops>;
};

// Optional functions of a protocol.

/// Protocol with timers, set by LinkLayer::timer. A timer cannot be cancelled: on_timer checks
/// whether the timer is still wanted. `tag` is the value passed to LinkLayer::timer.
template <class T>
concept HasTimers = requires(T router, LinkLayer& link, NodeId node, std::uint64_t tag) {
    {router.on_timer(link, node, tag)};
};
/// Protocol that stores data of messages: forget() is called when a message is gone and its slot of
/// the table is free.
template <class T>
concept ForgetsMessages = requires(T router, MessageId message) {
    {router.forget(message)};
};
/// Protocol that stores headers of frames: forget_header() is called when no frame has the header
/// any more, and its number may be used again.
template <class T>
concept ForgetsHeaders = requires(T router, std::uint32_t header) {
    {router.forget_header(header)};
};
/// Protocol that is notified of the results of its frames: every frame that was sent and neither
/// cancelled nor taken causes one call. The call never occurs inside a call of the protocol to the
/// link layer. After a failure the protocol sends the packet again, or drops the packet by
/// LinkLayer::drop.
template <class T>
concept HearsOfResults = requires(T router, LinkLayer& link, const QueuedFrame& frame,
                                  SendResult result) {
    {router.on_sent(link, frame, result)};
};
/// Protocol that knows to which messages it holds references. A debug build checks at the end of
/// the run that the protocol holds no other references.
template <class T>
concept KeepsMessages = requires(const T router, MessageId message) {
    { router.keeps(message) } -> std::convertible_to<bool>;
};
/// Style of a packet's content in ns-2 traces: old or new trace format.
enum class PacketStyle {
    /// Style of the old trace format: "[0x2 1 1 [3 0] [0 4]] (REQUEST)"
    brackets,
    /// Style of the new trace format: "-P aodv -Pt 0x2 -Ph 1 ... -Pc REQUEST "
    tags,
};
/// Protocol that shows the content of its control packets in traces: describe() appends the content
/// to `text`.
template <class T>
concept DescribesPackets = requires(const T router, const Message& message, const Frame& frame,
                                    PacketStyle style, std::string& text) {
    {router.describe(message, frame, style, text)};
};
/// Protocol that shows the headers of its frames (Frame::header) in recorded traces and captures.
/// header_bytes() returns the header that is transmitted with the frame.
template <class T>
concept ShowsHeaders = requires(const T router, const Frame& frame) {
    { router.header_bytes(frame) } -> std::convertible_to<FrameHeader>;
};
/// Protocol that is notified of node starts: on_start is called for each node when the run begins,
/// in the order of keys, or when the node is added later. HELLO messages start here.
template <class T>
concept HearsOfStarts = requires(T router, LinkLayer& link, NodeId node) {
    {router.on_start(link, node)};
};
/// Protocol that is notified when a node is switched off or on. Frames that wait for their send
/// time, and timers, remain; a frame from a node that is off is dropped.
template <class T>
concept HearsOfSwitches = requires(T router, LinkLayer& link, NodeId node, bool on) {
    {router.on_switched(link, node, on)};
};
/// Protocol whose messages have different initial TTLs.
template <class T>
concept HasOwnTtls = requires(const T router, const Message& message) {
    { router.initial_ttl(message) } -> std::convertible_to<Hops>;
};
/// Route of a node to a destination, for tables and pictures.
struct RouteState {
    NodeId destination;
    NodeId next_hop;
    /// Number of hops to the destination; for a broken route, the number before the break.
    Hops hops = 0;
    /// Sequence number of the destination; none if the protocol has no sequence numbers, or if the
    /// number is unknown.
    std::optional<std::uint32_t> number = std::nullopt;
    /// Whether messages may be sent along the route; false for a broken route.
    bool is_valid = true;
    /// Time at which the route was learnt.
    Time since = start_of_run;
    /// Time at which the route expires, or a broken route is forgotten; none if there is no such
    /// time.
    std::optional<Time> until = std::nullopt;
    /// Nodes of the route after its first node, up to the destination; empty if the protocol does
    /// not know them.
    std::vector<NodeId> path = {};
};
/// Protocol that shows the routing table of a node at `now`, in the order of destinations.
template <class T>
concept HasRoutes = requires(const T router, NodeId node, Time now) {
    { router.routes(node, now) } -> std::convertible_to<std::vector<RouteState>>;
};
/// Protocol with a notice to the user at the end of a run, such as a limit of the protocol that
/// caused losses. An empty text means no notice.
template <class T>
concept HasNotice = requires(const T router) {
    { router.notice() } -> std::convertible_to<std::string>;
};
/// Traits of a protocol: optional static members, false by default. The network reads them once,
/// when the protocol is set.
struct RouterTraits {
    /// True if the protocol routes messages to one node, not only to everyone. If false,
    /// Network::send() sends unicasts over one hop.
    bool routes_unicasts = false;
    /// True if on_receive also gets unicasts for other nodes (overhearing). The fates that
    /// on_receive sets for these unicasts are not recorded.
    bool overhears = false;
    /// True if the protocol calls LinkLayer::level, which needs a path loss for each reception.
    bool wants_levels = false;
    /// Names that Robot::role may have: the protocol treats nodes by their LinkLayer::role.
    std::span<const std::string_view> roles = {};
};

}  // namespace rovernet
