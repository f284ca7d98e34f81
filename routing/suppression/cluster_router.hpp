// SPDX-License-Identifier: MIT
#pragma once

#include "routing/suppression.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace rovernet {

/// Routing protocol for scheme "cluster" of a Suppression: lowest-key clusters, of which heads and
/// gateways forward messages. Each node announces the head of its cluster in HELLO packets. A node
/// is a head if none of its neighbours with a lower key (LinkLayer::key) is a head; otherwise the
/// node belongs to the neighbouring head with the lowest key. A gateway hears a node of another
/// cluster.
///
/// Clusters settle in the order of keys. Once settled, heads and gateways connect all nodes that a
/// plain flood connects: two neighbours of one cluster both hear their head, and two neighbours of
/// different clusters are gateways. A node stores 16 bytes for each neighbour, and a bit for each
/// message.
class ClusterRouter {
  public:
    /// @throws std::invalid_argument if a parameter is out of its range, or a threshold is given
    explicit ClusterRouter(const Suppression& suppression);

    Hops initial_ttl() const { return static_cast<Hops>(settings_.ttl); }
    void send(LinkLayer& link, NodeId node, MessageId message);
    void on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions);
    void on_start(LinkLayer& link, NodeId node);
    void on_timer(LinkLayer& link, NodeId node, std::uint64_t tag);
    void on_switched(LinkLayer& link, NodeId node, bool on);
    void forget(MessageId message);

    /// Head of a node's cluster; `everyone` before the node's first HELLO.
    NodeId head(NodeId node) const {
        return node.index() < nodes_.size() ? nodes_[node.index()].head : everyone;
    }
    /// Whether a node forwards messages: a head, a gateway, or a node without a cluster yet.
    bool is_relay(NodeId node, Time now) const;

  private:
    struct Neighbour {
        NodeId node, head;
        Time last;
    };
    struct Node {
        NodeId head = everyone;
        std::uint32_t hellos = 0;
        std::vector<Neighbour> neighbours;
    };
    Node& node(NodeId id);
    std::vector<bool>& heard(const LinkLayer& link, MessageId message);
    bool is_near(const Neighbour& each, Time now) const;
    void hear_hello(NodeId at, const Neighbour& sender);
    void join(const LinkLayer& link, NodeId at);
    void take(LinkLayer& link, const Frame& frame, Reception& reception);

    Suppression settings_;
    std::vector<Node> nodes_;
    std::vector<std::vector<bool>> heard_;  // nodes that have heard a message, by message and node
    std::vector<Reception*> news_;          // receptions of first copies; kept for its memory
};

}  // namespace rovernet
