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
/// Network::send calls Applications, which creates a Message, emits the record Sent and passes the
/// message to Routing. Routing calls Applications as its RoutingUser when messages are delivered.
/// Each receiving robot with a callback then reacts 1 us later, by a separate event.
class Applications final : public RoutingUser {
  public:
    /// @param routing  layer below, which may still be under construction
    /// @param mac      for saturated traffic, which needs a MAC that queues frames
    Applications(World& world, Routing& routing, const Mac& mac)
        : world_(world), routing_(routing), mac_(mac) {}

    /// Sends a message to `to`, a robot or everyone; implements Network::send.
    /// @return uid of the message; empty if `from` is switched off
    std::optional<std::uint64_t> send(NodeId from, NodeId to, std::string payload,
                                      const SendOptions& options);
    /// Starts saturated traffic of a node; implements Network::saturate. Two messages are queued at
    /// the start, and each message that has left the queue is followed by a new message.
    /// If the node is switched off and on again, the traffic goes on.
    /// @throws std::invalid_argument without an access model, because sending would be unlimited
    void saturate(NodeId node, NodeId to, std::string payload, const SendOptions& options);
    /// Whether any message was sent so far. If so, the error at the event limit advises the user to
    /// send fewer messages.
    bool has_sent() const { return has_sent_; }
    /// Calls `react` 1 us after each delivery of a message to `node`; implements
    /// Network::on_receive.
    void on_receive(NodeId node, Callback<const Heard&> react, HearOptions options);
    /// Serves the event of a message delivered to `node`: calls the node's callbacks, if the node
    /// is still on. Nodes that receive messages at the same time react in the order of their keys.
    /// @param slot  slot of the delivery in deliveries_
    void react(NodeId node, std::size_t slot);
    /// Emits Dropped, at the end of the run, for each message that is on its way; implements
    /// Network::finish.
    void cut_off();

    /// Implements RoutingUser: queues the callbacks of nodes to which the message of a frame is
    /// delivered.
    void delivered(const Frame& frame, std::span<const Reception> receptions,
                   std::span<const Dbm> levels) override;
    /// Implements RoutingUser: a node with saturated traffic sends its next message.
    void left_queue(NodeId node, const Message& message, bool has_room) override;
    /// Sends messages of a node with saturated traffic, 1 us later, until two messages wait.
    void refill(NodeId node);

  private:
    /// Saturated traffic of a node: destination, payload and options of the node's messages.
    struct Saturated {
        NodeId to;
        std::string payload;
        SendOptions options;
        /// Messages in the node's queue, by uid, and number of messages that are about to be sent.
        std::vector<std::uint64_t> waiting = {};
        std::size_t coming = 0;
    };
    /// Callback of a node for received messages, and the callback's options.
    struct Reaction {
        Callback<const Heard&> call;
        HearOptions options;
    };
    /// Delivery of a message to a node whose callbacks have not run yet. A Delivery holds a
    /// reference to the message.
    struct Delivery {
        MessageId message;
        NodeId last_hop;
        Hops hops;
        /// Received power of the frame [dBm]; NaN if the power was not requested at the node.
        Dbm level;
    };

    // Whether the node has a callback for received messages.
    bool reacts(NodeId node) const {
        return node.index() < reactions_.size() && !reactions_[node.index()].empty();
    }
    // Whether the routing protocol forwards a message from `from` to `to`; false for a message over
    // one hop. @throws as Network::send
    bool is_routed(NodeId from, NodeId to, bool one_hop) const;
    // Stores a new message of the node `from`, with one reference, which the caller holds.
    MessageId new_message(NodeId from, NodeId to, std::string payload, const SendOptions& options,
                          bool is_routed);
    void send_saturated(NodeId from, Saturated& traffic);
    std::optional<std::uint32_t> reachable(NodeId from, NodeId to);
    std::optional<std::uint32_t> shortest(NodeId from, NodeId to);

    World& world_;
    Routing& routing_;
    const Mac& mac_;
    // Number of messages sent by each node, and callbacks of each node, by node id. Each of these
    // two lists ends at the last node with an entry.
    std::vector<std::uint32_t> messages_sent_;
    std::vector<Few<Reaction>> reactions_;
    // Deliveries whose events are queued.
    Slots<Delivery> deliveries_;
    // Saturated traffic, by sending node; a node may have several destinations.
    std::map<NodeId, std::vector<Saturated>> saturated_;
    // Search that computes Sent::reachable; kept to reuse its memory.
    Reachability reachability_;
    bool has_sent_ = false;
    // Indices of the receptions of one frame at nodes with callbacks; kept to reuse its memory.
    std::vector<std::size_t> reacting_;
};

}  // namespace rovernet
