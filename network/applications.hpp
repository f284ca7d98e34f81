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

/// Part of a message that its sender chooses, beside its payload.
struct Outgoing {
    /// Size on air [bytes], without what the access model adds.
    std::uint32_t bytes;
    /// Flow that it belongs to, from 1; 0: none.
    std::uint32_t flow = 0;
};

/// Applications of all robots: what robots say to one another, and what they do when they hear it.
///
/// Network calls it to send; it makes a Message, emits Sent and hands the message to Routing.
/// Routing tells it, as its RoutingUser, of what was delivered: each robot with a callback then
/// reacts 1 us later, by an event of its own.
class Applications final : public RoutingUser {
  public:
    /// @param routing  layer below, which may still be under construction
    /// @param mac      asked whether frames can wait, for saturated traffic
    Applications(World& world, Routing& routing, const Mac& mac)
        : world_(world), routing_(routing), mac_(mac) {}

    /// Sends a message by the routing protocol, as Network::broadcast and Network::send. A node
    /// that is off says nothing.
    /// @throws std::invalid_argument without a protocol, for a unicast that the protocol cannot
    /// route, and for a destination that is no other robot
    void send(NodeId node, NodeId to, std::string payload, Outgoing what);
    /// Sends a message over one hop, past the protocol, as Network::unicast.
    /// @throws std::invalid_argument for a destination that is no other robot
    void send_one_hop(NodeId node, NodeId to, std::string payload, Outgoing what);
    /// Keeps a node sending over one hop, as Network::saturate: two messages wait from the start,
    /// and each that is sent makes another.
    /// @throws std::invalid_argument without an access model, as nothing would hold it back
    void saturate(NodeId node, NodeId to, Outgoing what);
    /// Whether somebody has sent a message; the advice of an error depends on it.
    bool has_sent() const { return has_sent_; }
    /// Calls react(message, how) whenever `node` is handed a message.
    void on_receive(NodeId node, Callback<const Message&, const Heard&> react);
    /// Serves the event of a message that a node was handed: its callbacks are called now, if it is
    /// still on. Nodes that are handed a message at one time react in the order of their keys.
    /// @param handed_over  the message's id, and above its 32 bits the hops
    void react(NodeId node, std::uint64_t handed_over);
    /// Drops the messages that have arrived nowhere and are still under way, as Network::finish.
    void cut_off();

    /// RoutingUser: receptions of which some are delivered.
    void delivered(const Frame& frame, std::span<const Reception> receptions) override;
    /// RoutingUser: a saturated node sends its next message.
    void has_room(NodeId node) override;

  private:
    /// Traffic of a node that always has something to send.
    struct Saturated {
        NodeId to;
        Outgoing what;
    };

    // Whether the node has a callback for messages.
    bool reacts(NodeId node) const {
        return node.index() < on_receive_.size() && !on_receive_[node.index()].empty();
    }
    void check_destination(NodeId from, NodeId to) const;
    // Stores a message of the node's, held once by the caller.
    MessageId new_message(NodeId node, NodeId to, std::string payload, Outgoing what,
                          bool is_routed);
    std::optional<std::uint32_t> reachable(NodeId from, NodeId to);

    World& world_;
    Routing& routing_;
    const Mac& mac_;
    // By node, up to the last that there is something of: mostly nothing. Messages of each node so
    // far, and its callbacks; up to the last node that has any.
    std::vector<std::uint32_t> messages_sent_;
    std::vector<Few<Callback<const Message&, const Heard&>>> on_receive_;
    // Nodes that always have something to send, by id.
    std::map<NodeId, Saturated> saturated_;
    // Search for Sent::reachable, which keeps its memory.
    Reachability reachability_;
    bool has_sent_ = false;
    // Receptions of one frame whose nodes react; kept for its memory.
    std::vector<Reception> reacting_;
};

}  // namespace rovernet
