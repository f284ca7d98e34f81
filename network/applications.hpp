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

/// What an application says of a message.
struct Outgoing {
    std::uint32_t bytes;     ///< [bytes] on air
    std::uint32_t flow = 0;  ///< see Message
};

/// What robots say to one another, and what they do when they hear it.
class Applications final : public RoutingUser {
  public:
    Applications(World& world, Routing& routing, const Mac& mac)
        : world_(world), routing_(routing), mac_(mac) {}

    // As Network::send, unicast and saturate.
    void send(NodeId node, NodeId to, std::string payload, Outgoing what);
    void send_one_hop(NodeId node, NodeId to, std::string payload, Outgoing what);
    void saturate(NodeId node, NodeId to, Outgoing what);
    /// Somebody has sent a message.
    bool has_sent() const { return has_sent_; }
    void on_receive(NodeId node, Callback<const Message&, const Heard&> react);
    /// Serves the event of a message that a node was handed: it reacts now.
    /// @param handed_over  the message's id, and above its 32 bits the hops
    void react(NodeId node, std::uint64_t handed_over);
    /// As Network::finish.
    void cut_off();

    // RoutingUser.
    void delivered(const Frame& frame, std::span<const Reception> receptions) override;
    void has_room(NodeId node) override;

  private:
    /// A node always has something to send.
    struct Saturated {
        NodeId to;
        Outgoing what;
    };

    bool reacts(NodeId node) const {
        return node.index() < on_receive_.size() && !on_receive_[node.index()].empty();
    }
    void check_destination(NodeId from, NodeId to) const;
    MessageId new_message(NodeId node, NodeId to, std::string payload, Outgoing what,
                          bool is_routed);
    std::optional<std::uint32_t> reachable(NodeId from, NodeId to);

    World& world_;
    Routing& routing_;
    const Mac& mac_;
    // By node, up to the last that there is something of: mostly nothing.
    std::vector<std::uint32_t> messages_sent_;
    std::vector<Few<Callback<const Message&, const Heard&>>> on_receive_;
    std::map<NodeId, Saturated> saturated_;
    Reachability reachability_;
    bool has_sent_ = false;
    std::vector<Reception> reacting_;  // of a frame
};

}  // namespace rovernet
