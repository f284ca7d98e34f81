// SPDX-License-Identifier: MIT
#pragma once

#include "models/medium/reachability.hpp"
#include "network/callback.hpp"
#include "network/few.hpp"
#include "network/network.hpp"
#include "network/routing.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

struct World;

/// Parameters of a message that its sender chooses, besides the payload.
struct Outgoing {
    /// Size on air [bytes], without the bytes that the access model adds.
    std::uint32_t bytes;
    /// Number of the message's flow, from 1; 0 for no flow.
    std::uint32_t flow = 0;
};

/// Applications of all robots: messages that robots send, and callbacks for received messages.
///
/// Network calls it to send; it creates a Message, emits Sent and passes the message to Routing.
/// Routing calls it back, as its RoutingUser, for delivered messages: each robot with a callback
/// then reacts 1 us later, by a separate event.
class Applications final : public RoutingUser {
  public:
    /// @param routing  layer below, which may still be under construction
    /// @param mac      for saturated traffic, which needs a MAC that queues frames
    Applications(World& world, Routing& routing, const Mac& mac)
        : world_(world), routing_(routing), mac_(mac) {}

    /// Sends a message by the routing protocol, as Network::broadcast and Network::send. A node
    /// that is off does not send.
    /// @throws std::invalid_argument without a protocol, for a unicast that the protocol cannot
    ///         route, and for an invalid destination
    void send(NodeId node, NodeId to, std::string payload, Outgoing what);
    /// Sends a message over one hop without the protocol, as Network::unicast.
    /// @throws std::invalid_argument for an invalid destination
    void send_one_hop(NodeId node, NodeId to, std::string payload, Outgoing what);
    /// Starts saturated traffic of a node over one hop, as Network::saturate: two messages are
    /// queued at the start, and each message sent creates the next.
    /// @throws std::invalid_argument without an access model, because sending would be unlimited
    void saturate(NodeId node, NodeId to, Outgoing what);
    /// True once any message was sent; selects the hint in the event-limit error.
    bool has_sent() const { return has_sent_; }
    /// Calls react(message, how) whenever a message is delivered to `node`.
    void on_receive(NodeId node, Callback<const Message&, const Heard&> react);
    /// Serves the event of a delivered message: calls the node's callbacks, if it is still on.
    /// Nodes with messages at the same time react in the order of their keys.
    /// @param handed_over  id of the message in the lower 32 bits, hops above
    void react(NodeId node, std::uint64_t handed_over);
    /// Drops the messages of which no frame has ended yet, as Network::finish.
    void cut_off();

    /// Implements RoutingUser: handles receptions of which some are delivered to an application.
    void delivered(const Frame& frame, std::span<const Reception> receptions) override;
    /// Implements RoutingUser: sends the next message of a node with saturated traffic.
    void has_room(NodeId node) override;

  private:
    /// Saturated traffic of a node.
    struct Saturated {
        NodeId to;
        Outgoing what;
    };

    // Whether the node has a callback for messages.
    bool reacts(NodeId node) const {
        return node.index() < on_receive_.size() && !on_receive_[node.index()].empty();
    }
    void check_destination(NodeId from, NodeId to) const;
    // Stores a message of the node with one reference, the caller's.
    MessageId new_message(NodeId node, NodeId to, std::string payload, Outgoing what,
                          bool is_routed);
    std::optional<std::uint32_t> reachable(NodeId from, NodeId to);

    World& world_;
    Routing& routing_;
    const Mac& mac_;
    // Number of messages sent by each node, and callbacks of each node. The lists end at the last
    // node that has any.
    std::vector<std::uint32_t> messages_sent_;
    std::vector<Few<Callback<const Message&, const Heard&>>> on_receive_;
    // Nodes with saturated traffic.
    std::map<NodeId, Saturated> saturated_;
    // Search for Sent::reachable; kept to reuse its memory.
    Reachability reachability_;
    bool has_sent_ = false;
    // Receptions of one frame at nodes with callbacks; kept to reuse its memory.
    std::vector<Reception> reacting_;
};

}  // namespace rovernet
