// SPDX-License-Identifier: MIT
#pragma once

#include "routing/flood.hpp"
#include "sim/sieve.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace rovernet {

/// Routing protocol with the parameters of a Flood. For each message in use the protocol stores a
/// bit per node, and four more bytes per node if copies after the first one may be forwarded or
/// raise a TTL.
class FloodRouter {
  public:
    /// @throws std::invalid_argument if a parameter is out of its range
    explicit FloodRouter(const Flood& flood);

    Hops initial_ttl() const { return static_cast<Hops>(flood_.ttl); }
    Hops initial_ttl(const Message& message) const;
    void send(LinkLayer& link, NodeId node, MessageId message);
    void on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions);
    void forget(MessageId message);

  private:
    /// State of a message at a node, from the copies received so far.
    class Knowledge {
      public:
        enum State : std::uint32_t { unheard, ended, waiting };
        Knowledge(State state = unheard, SendHandle copy = 0) : value_(state + copy) {}

        bool is(State state) const {
            return state == waiting ? value_ >= waiting : value_ == state;
        }
        /// Handle of the copy that waits to be forwarded, or was forwarded; only in the state
        /// `waiting`.
        SendHandle copy() const { return value_ - waiting; }

      private:
        std::uint32_t value_;  // State; for a waiting copy `waiting` plus the copy's handle
    };

    /// State of one message in use, at all nodes.
    class Known {
      public:
        std::size_t size() const { return 64 * settled_.size(); }
        void resize(std::size_t nodes, bool later_copies_matter) {
            settled_.resize((nodes + 63) / 64);
            if (later_copies_matter) of_nodes_.resize(size());
        }
        /// Whether any further copy of the message is a duplicate for the node, whatever its TTL.
        bool is_settled(NodeId node) const {
            return settled_[node.index() / 64] >> node.index() % 64 & 1;
        }
        void settle(NodeId node) {
            settled_[node.index() / 64] |= std::uint64_t{1} << node.index() % 64;
        }
        /// State of the message at a node; only stored if later_copies_matter().
        Knowledge& operator[](NodeId node) { return of_nodes_[node.index()]; }

      private:
        // Bit of each node: true if any further copy of the message is a duplicate for the node,
        // see is_settled(). The bits of a million nodes fit into the processor's cache.
        std::vector<std::uint64_t> settled_;
        std::vector<Knowledge> of_nodes_;
    };

    Known& known(const LinkLayer& link, MessageId message) {
        const std::size_t i = message.index(), nodes = link.size();
        if (i >= known_.size() || known_[i].size() < nodes) [[unlikely]]
            make_room(i, nodes);
        return known_[i];
    }
    void make_room(std::size_t message, std::size_t nodes);
    bool forwards_all() const { return flood_.duplicates == Duplicates::forward; }
    /// Whether a copy of a message after the first one may be forwarded or raise a TTL.
    bool later_copies_matter() const { return forwards_all() || flood_.upgrade; }
    bool is_duplicate(LinkLayer& link, const Frame& frame, NodeId node, Known& known);
    void take(LinkLayer& link, const Frame& frame, Known& known, Reception& reception);
    SendHandle forward(LinkLayer& link, const Frame& frame, const Reception& reception);

    Flood flood_;
    std::vector<Known> known_;  // state of each message in use, by message
    Sieve<Reception*> news_;    // receptions of a frame, no duplicates; kept to reuse its memory
};

}  // namespace rovernet
