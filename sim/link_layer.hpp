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

namespace rovernet {

/// No node reacts to a reception faster than this, which is what lets one event stand for all the
/// receptions of a transmission.
inline constexpr Duration least_reaction{1000};

/// A frame that waits for its time, see LinkLayer::waiting.
using SendHandle = std::uint32_t;

/// What became of a frame that a router sent.
enum class SendResult : std::uint8_t {
    acked,       ///< its next hop acknowledged it
    sent,        ///< it was on air; whether anybody got it is not known
    retries,     ///< no acknowledgement came, however often it was sent
    queue_full,  ///< its sender's queue had no room for it
    off,         ///< its sender was switched off before it was on air
};

/// What a router may do. Implemented by the Network; users only call it.
class LinkLayer {
  public:
    virtual Time now() const = 0;
    /// Nodes so far; their ids are 0 ... size - 1.
    virtual std::size_t size() const = 0;
    virtual const Message& message(MessageId) const = 0;
    virtual bool is_on(NodeId) const = 0;
    /// The node's key, for keys of random draws; unlike its id it does not depend on other nodes.
    virtual std::uint64_t key(NodeId) const = 0;
    /// [m] Where the node is now.
    virtual Vec3 position(NodeId) const = 0;

    /// Makes a packet of the protocol's own, held once by the caller; no application is told of it.
    /// @param kind     what its records call it, a literal: "rreq"
    /// @param bytes    [bytes] on air
    /// @param content  what it says
    virtual MessageId originate(NodeId from, NodeId to, std::string_view kind, std::uint32_t bytes,
                                std::string content) = 0;
    /// Puts a frame on air from frame.sender at `at`, for frame.next_hop or for everyone. Now means
    /// as soon as the router's own function has returned; in answer to a reception it is at least
    /// `least_reaction` after that. If the sender is off by then, a Dropped says so.
    /// @param heard_from  who the sender received it from; nothing if it originates the frame
    /// @return a handle until then; nothing if that is now
    /// @throws std::invalid_argument if `at` is too early
    virtual std::optional<SendHandle> send(const Frame& frame, std::optional<NodeId> heard_from,
                                           Time at) = 0;
    /// A frame that waits for its time: it may be changed, but for its message and its sender.
    /// Null once its time has come. Later the handle may be another frame's: compare message and
    /// sender.
    virtual QueuedFrame* waiting(SendHandle) = 0;
    /// Takes back a frame that waits for its time.
    virtual void cancel(SendHandle) = 0;
    /// Takes the frames for `next_hop` out of the queue in which `node` waits for access, but for
    /// one that is being sent. The caller holds their messages now.
    virtual std::vector<QueuedFrame> take_queued(NodeId node, NodeId next_hop) = 0;
    /// Records that `node` loses a copy, `frame` as received.
    virtual void drop(NodeId node, const Frame& frame, DropReason reason) = 0;
    /// [dBm] Received power of a reception that on_receive was given, while that runs; for
    /// protocols with `wants_levels`.
    virtual Dbm level(const Reception&) const = 0;

    /// Calls the router's on_timer(node, tag) at `at`; in answer to a reception that is at least
    /// `least_reaction` after it. There is no way back: look at `now` and a deadline of your own.
    virtual void timer(NodeId node, Time at, std::uint64_t tag) = 0;
    /// Keeps a message in the table while the router holds a copy of it.
    virtual void hold(MessageId) = 0;
    virtual void release(MessageId) = 0;
    /// A uniform draw in (0, 1), keyed by the run, the purpose, the node, the message and `index`.
    virtual double draw(Purpose, NodeId, MessageId, std::uint64_t index) const = 0;
    /// The node's `index`-th uniform draw in (0, 1) for this purpose, of no message.
    virtual double draw(Purpose, NodeId, std::uint64_t index) const = 0;

  protected:
    ~LinkLayer() = default;
};

}  // namespace rovernet
