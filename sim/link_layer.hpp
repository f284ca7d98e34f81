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

// The link layer as a routing protocol sees it. Routing (network/routing.hpp) implements it over
// the MAC; tests of protocols have a fake one.

namespace rovernet {

/// Least time [ns] between a reception and what a node does about it: 1 us. It lets one event stand
/// for all the receptions of a transmission.
inline constexpr Duration least_reaction{1000};

/// Handle of a frame that waits for its time, see LinkLayer::waiting.
using SendHandle = std::uint32_t;

/// Result of sending a frame, for protocols that HearsOfResults. Broadcasts end as `sent` at best;
/// unicasts as `acked` where the access model acknowledges.
enum class SendResult : std::uint8_t {
    /// Its next hop acknowledged it.
    acked,
    /// It was on air; whether anybody got it is not known.
    sent,
    /// No acknowledgement came, however often it was sent.
    retries,
    /// Its sender's queue had no room for it.
    queue_full,
    /// Its sender was switched off before it was on air.
    off,
};

/// Functions that a routing protocol may call, from within its own functions only. A protocol has
/// all its nodes in one object, so that each call says which node acts.
///
/// A node knows what it heard: a protocol that asks for the position of another node, or reads
/// another node's state, models what no radio brings.
class LinkLayer {
  public:
    /// Time of the event that is served; in on_receive that of the last reception.
    virtual Time now() const = 0;
    /// Number of nodes so far; their ids are 0 ... size - 1.
    virtual std::size_t size() const = 0;
    /// Message of that id, which must be held; good until the next originate().
    virtual const Message& message(MessageId) const = 0;
    /// Whether the node's radio is on.
    virtual bool is_on(NodeId) const = 0;
    /// Key of the node, for keys of random draws and for orders; unlike its id it does not depend
    /// on other nodes.
    virtual std::uint64_t key(NodeId) const = 0;
    /// Position of the node now [m].
    virtual Vec3 position(NodeId) const = 0;

    /// Makes a packet of the protocol's own, held once by the caller: release() it when it is no
    /// longer needed. No application is told of it, and it has no Sent.
    /// @param to       destination of the packet; `everyone` for a broadcast
    /// @param kind     name of its kind in records, a literal: "rreq"
    /// @param bytes    size on air [bytes]
    /// @param content  what it says, for the protocol at the other end
    virtual MessageId originate(NodeId from, NodeId to, std::string_view kind, std::uint32_t bytes,
                                std::string content) = 0;
    /// Puts a frame on air from frame.sender at `at`, for frame.next_hop or for everyone. Now means
    /// as soon as the router's own function has returned; in answer to a reception it is at least
    /// `least_reaction` after that. If the sender is off by then, a Dropped says so. The frame
    /// holds its message.
    /// @param heard_from  node that the sender received it from; nothing if it originates the frame
    /// @return a handle until then; nothing if that is now
    /// @throws std::invalid_argument if `at` is too early
    virtual std::optional<SendHandle> send(const Frame& frame, std::optional<NodeId> heard_from,
                                           Time at) = 0;
    /// Frame that waits for its time: it may be changed, but for its message and its sender. Null
    /// once its time has come. Later the handle may be another frame's: compare message and sender.
    virtual QueuedFrame* waiting(SendHandle) = 0;
    /// Takes back a frame that waits for its time; nothing happens if that has come.
    virtual void cancel(SendHandle) = 0;
    /// Takes the frames for `next_hop` out of the queue in which `node` waits for access, but for
    /// one that is being sent: for a route that has broken. The caller holds their messages now.
    virtual std::vector<QueuedFrame> take_queued(NodeId node, NodeId next_hop) = 0;
    /// Records that `node` loses a copy.
    /// @param frame  as it was received
    virtual void drop(NodeId node, const Frame& frame, DropReason reason) = 0;
    /// Received power [dBm] of a reception that on_receive was given, while that runs; for
    /// protocols with `wants_levels`.
    virtual Dbm level(const Reception&) const = 0;

    /// Calls the router's on_timer(node, tag) at `at`; in answer to a reception that is at least
    /// `least_reaction` after it. There is no way back: look at now() and at a deadline of your
    /// own.
    /// @throws std::invalid_argument if `at` is before now
    virtual void timer(NodeId node, Time at, std::uint64_t tag) = 0;
    /// Keeps a message in the table while the router holds a copy of it.
    virtual void hold(MessageId) = 0;
    /// Gives up one hold of a message. After the last one the router's forget() is called, and the
    /// slot may be another message's.
    virtual void release(MessageId) = 0;
    /// Uniform draw in (0, 1), keyed by the run, the purpose, the node, the message and `index`.
    virtual double draw(Purpose, NodeId, MessageId, std::uint64_t index) const = 0;
    /// Uniform draw in (0, 1), the node's `index`-th for this purpose, of no message.
    virtual double draw(Purpose, NodeId, std::uint64_t index) const = 0;

  protected:
    ~LinkLayer() = default;
};

}  // namespace rovernet
