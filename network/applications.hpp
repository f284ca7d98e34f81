// SPDX-License-Identifier: MIT
#pragma once

#include "models/medium/reachability.hpp"
#include "network/callback.hpp"
#include "network/few.hpp"
#include "network/network.hpp"
#include "network/routing.hpp"
#include "sim/slots.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

struct World;

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

    /// Sends a message, as Network::send.
    std::optional<std::uint64_t> send(NodeId from, NodeId to, std::string payload,
                                      const SendOptions& options);
    /// Starts saturated traffic of a node, as Network::saturate: two messages are queued at the
    /// start, and each message sent creates the next.
    /// @throws std::invalid_argument without an access model, because sending would be unlimited
    void saturate(NodeId node, NodeId to, const SendOptions& options);
    /// True once any message was sent; selects the hint in the event-limit error.
    bool has_sent() const { return has_sent_; }
    /// Calls `react` whenever a message is delivered to `node`, as Network::on_receive.
    void on_receive(NodeId node, Callback<const Heard&> react, HearOptions options);
    /// Serves the event of a delivered message: calls the node's callbacks, if it is still on.
    /// Nodes with messages at the same time react in the order of their keys.
    /// @param slot  place of the delivery in deliveries_
    void react(NodeId node, std::size_t slot);
    /// Drops the messages of which no frame has ended yet, as Network::finish.
    void cut_off();

    /// Implements RoutingUser: handles receptions of which some are delivered to an application.
    void delivered(const Frame& frame, std::span<const Reception> receptions,
                   std::span<const Dbm> levels) override;
    /// Implements RoutingUser: sends the next message of a node with saturated traffic.
    void has_room(NodeId node) override;

  private:
    /// Saturated traffic of a node.
    struct Saturated {
        NodeId to;
        SendOptions options;
    };
    /// Callback of a node.
    struct Reaction {
        Callback<const Heard&> call;
        HearOptions options;
    };
    /// Message on its way from routing to the callbacks of a node; it holds a reference to the
    /// message.
    struct Delivery {
        MessageId message;
        NodeId last_hop;
        Hops hops;
        /// Received power [dBm]; NaN unless a callback asked for it.
        Dbm level;
    };

    // Whether the node has a callback for messages.
    bool reacts(NodeId node) const {
        return node.index() < reactions_.size() && !reactions_[node.index()].empty();
    }
    // Whether the routing protocol forwards a message. @throws as Network::send
    bool is_routed(NodeId from, NodeId to, bool one_hop) const;
    // Stores a message of the node with one reference, the caller's.
    MessageId new_message(NodeId from, NodeId to, std::string payload, const SendOptions& options,
                          bool is_routed);
    std::optional<std::uint32_t> reachable(NodeId from, NodeId to);
    std::optional<std::uint32_t> shortest(NodeId from, NodeId to);

    World& world_;
    Routing& routing_;
    const Mac& mac_;
    // Number of messages sent by each node, and callbacks of each node. The lists end at the last
    // node that has any.
    std::vector<std::uint32_t> messages_sent_;
    std::vector<Few<Reaction>> reactions_;
    // Deliveries whose events are due.
    Slots<Delivery> deliveries_;
    // Nodes with saturated traffic.
    std::map<NodeId, Saturated> saturated_;
    // Search for Sent::reachable; kept to reuse its memory.
    Reachability reachability_;
    bool has_sent_ = false;
    // Indices of the receptions of one frame at nodes with callbacks; kept to reuse its memory.
    std::vector<std::size_t> reacting_;
};

}  // namespace rovernet
