// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/message.hpp"
#include "sim/random.hpp"
#include "sim/record.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Interface of the link layer for routing protocols. Routing (network/routing.hpp) implements it
// over the MAC; tests of protocols use a fake link layer.

namespace rovernet {

/// Shortest time [ns] between a reception and the receiving node's reaction: 1 us. Therefore one
/// event can serve all receptions of a transmission.
inline constexpr Duration least_reaction{1000};

/// Handle of a frame that waits for its send time, see LinkLayer::waiting.
using SendHandle = std::uint32_t;

/// Result of sending a frame, for protocols that satisfy HearsOfResults. A broadcast ends as `sent`
/// at best, a unicast as `acked`. An access model without acknowledgements acts as an ideal MAC: at
/// the end of the frame it knows whether the next hop received the frame.
enum class SendResult : std::uint8_t {
    /// The next hop acknowledged the frame.
    acked,
    /// The frame was transmitted; whether it was received is not known.
    sent,
    /// No acknowledgement came within the retry limit; without acknowledgements, the next hop did
    /// not receive the frame.
    retries,
    /// The sender's queue was full.
    queue_full,
    /// The sender was switched off before the frame was transmitted.
    off,
    /// A later frame took the frame's place before the next hop's address was resolved (ARP).
    displaced,
};

/// Reason of a packet's loss after a failed result, for protocols that do not send it again.
constexpr DropReason drop_reason_of(SendResult result) {
    switch (result) {
        case SendResult::off: return DropReason::off;
        case SendResult::displaced: return DropReason::unresolved;
        case SendResult::queue_full: return DropReason::queue_full;
        default: return DropReason::retries;
    }
}

/// Link layer: functions that a routing protocol may call, only from within its own functions. One
/// protocol object serves all nodes, so every call has the acting node as an argument.
///
/// A protocol should use only what the acting node has received: reading the position or the state
/// of another node models information that no radio carries.
class LinkLayer {
  public:
    /// Time of the current event; in on_receive the time of the last reception.
    virtual Time now() const = 0;
    /// Number of nodes so far; their ids are 0 ... size - 1.
    virtual std::size_t size() const = 0;
    /// Message with this id, which must be in use; the reference is valid until the next
    /// originate().
    virtual const Message& message(MessageId) const = 0;
    /// Whether the node's radio is on.
    virtual bool is_on(NodeId) const = 0;
    /// Key of the node, for random draws and for orderings; unlike the id, the key does not depend
    /// on other nodes.
    virtual std::uint64_t key(NodeId) const = 0;
    /// Fetches what key() and draw() read of the node into the processor's cache. A protocol that
    /// serves several nodes calls this for all of them first, so that it waits for memory once.
    virtual void prefetch(NodeId) const {}
    /// Current position of the node [m].
    virtual Vec3 position(NodeId) const = 0;
    /// Role of the node in the protocol, Robot::role; empty if none was given.
    virtual std::string_view role(NodeId) const = 0;

    /// Makes a control packet of the protocol, with one reference, the caller's: release() the
    /// message when it is no longer needed. Applications do not receive a control packet, and it
    /// has no Sent record.
    /// @param to       destination of the packet; `everyone` for a broadcast
    /// @param kind     name of the packet's kind in records, a literal: "rreq"
    /// @param bytes    size on air [bytes]
    /// @param content  content of the packet, for the protocol at the receiver
    virtual MessageId originate(NodeId from, NodeId to, std::string_view kind, std::uint32_t bytes,
                                std::string content) = 0;
    /// Transmits a frame from frame.sender at the time `at`, to frame.next_hop or to everyone. If
    /// `at` is now(), the frame is sent when the protocol's current function has returned. A frame
    /// in reaction to a reception is sent at least `least_reaction` after the reception. If the
    /// sender is off at the send time, a Dropped record is emitted. The frame holds a reference to
    /// its message, and to its header if frame.header names an entry of the protocol's own header
    /// table. The protocol must not change that entry until forget_header() is called.
    /// @param heard_from  node from which the sender received the frame; empty if the sender
    ///     originates it
    /// @return handle of the waiting frame; empty if `at` is now
    /// @throws std::invalid_argument if `at` is too early
    virtual std::optional<SendHandle> send(const Frame& frame, std::optional<NodeId> heard_from,
                                           Time at) = 0;
    /// Time [ns] between the starts of two frames that a node sends one after the other, so that
    /// the frames and their forwarded copies do not collide. 0 if the access model queues frames.
    /// Four airtimes without an access model: the next hops forward the first frame in this time.
    virtual Duration spacing(const Frame&) const { return Duration{0}; }
    /// Frame that waits for its send time. The protocol may change the frame, except for its
    /// message and its sender. Null once the send time has come. A handle may be reused for a later
    /// frame: compare message and sender.
    virtual QueuedFrame* waiting(SendHandle) = 0;
    /// Cancels a frame that waits for its send time; does nothing after that time.
    virtual void cancel(SendHandle) = 0;
    /// Removes the protocol's frames for `next_hop` from the interface queue of `node`, except a
    /// frame that is on air or waits for its acknowledgement; used when a route has broken.
    /// Messages over one hop stay in the queue. The removed frames have no result. The caller then
    /// holds their references: release(frame.frame). Frames that wait for their send time are not
    /// in this queue: cancel() them by their handles.
    virtual std::vector<QueuedFrame> take_queued(NodeId node, NodeId next_hop) = 0;
    /// Records that `node` loses a copy of a message. Within on_receive the record follows the
    /// Received record of the frame, at the time of the node's reception.
    /// @param frame     frame as the node received it
    /// @param own_code  code in traces, a literal, for DropReason::own
    virtual void drop(NodeId node, const Frame& frame, DropReason reason,
                      std::string_view own_code = {}) = 0;
    /// Received power [dBm] of a reception passed to on_receive, only during that call; for
    /// protocols with `wants_levels`.
    virtual Dbm level(const Reception&) const = 0;
    /// Ratio of a reception's power to the noise floor of its receiver [dB]. The conditions of
    /// level() apply: only during on_receive, for protocols with `wants_levels`.
    virtual Db snr(const Reception&) const = 0;

    /// Calls the router's on_timer(node, tag) at `at`; in reaction to a reception at least
    /// `least_reaction` later. A timer cannot be cancelled: on_timer should compare now() with a
    /// stored deadline.
    /// @throws std::invalid_argument if `at` is before now
    virtual void timer(NodeId node, Time at, std::uint64_t tag) = 0;
    /// Adds a reference to a message, which keeps it in the table while the router stores its id.
    virtual void hold(MessageId) = 0;
    /// Removes a reference to a message. After the last reference is removed, the router's forget()
    /// is called, and the slot may be reused.
    virtual void release(MessageId) = 0;
    /// Adds a reference to the message and to the header of a frame. Must be called for each frame
    /// that the router stores, so that message and header remain in memory.
    virtual void hold(const Frame&) = 0;
    /// Removes the references that hold(frame) added. After the last reference to a header is
    /// removed, the router's forget_header() is called.
    virtual void release(const Frame&) = 0;
    /// Uniform draw in (0, 1), keyed by the run, the purpose, the node, the message and `index`.
    virtual double draw(Purpose, NodeId, MessageId, std::uint64_t index) const = 0;
    /// Uniform draw in (0, 1), not for a message: number `index` of the node for this purpose.
    virtual double draw(Purpose, NodeId, std::uint64_t index) const = 0;

  protected:
    ~LinkLayer() = default;
};

}  // namespace rovernet
