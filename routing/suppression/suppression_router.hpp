// SPDX-License-Identifier: MIT
#pragma once

#include "routing/suppression.hpp"
#include "sim/sieve.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace rovernet {

/// Routing protocol with the parameters of a Suppression, except for scheme "cluster"
/// (ClusterRouter). For each message in use the protocol stores a bit per node. All schemes except
/// "probability" also store four bytes per node, and twelve bytes for each node that waits or has
/// waited. Scheme "location" also stores the position of each sender that such a node has heard.
///
/// All schemes are monotone: further copies only add reasons not to forward. A waiting copy is
/// therefore cancelled when a received copy meets the scheme's condition, not at the end of the
/// delay.
class SuppressionRouter {
  public:
    /// @throws std::invalid_argument if a parameter is out of its range, or of its scheme's range
    explicit SuppressionRouter(const Suppression& suppression);

    Hops initial_ttl() const { return static_cast<Hops>(settings_.ttl); }
    void send(LinkLayer& link, NodeId node, MessageId message);
    void on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions);
    void forget(MessageId message);

  private:
    /// Frame that nodes hear, and position of its sender [m]; the position is only set if
    /// places_matter().
    struct Heard {
        const Frame& frame;
        Vec3 from;
    };
    /// Wait of a node for the send time of its copy.
    struct Wait {
        SendHandle copy = 0;
        /// Number of copies that the node has heard so far, for "counter".
        std::uint32_t copies = 0;
        /// Last sender that the node heard, for "location": index in Known::senders + 1; 0 for
        /// none.
        std::uint32_t last_sender = 0;
    };
    /// Sender that a node heard: its position [m], and the node's previous sender, as index in
    /// Known::senders + 1; 0 for none.
    struct Sender {
        Vec3 at;
        std::uint32_t before;
    };
    /// State of one message in use, at all nodes.
    struct Known {
        std::size_t size() const { return 64 * decided.size(); }
        void resize(std::size_t nodes, bool waits_matter) {
            decided.resize((nodes + 63) / 64);
            if (waits_matter) wait_of.resize(size());
        }
        bool is_decided(NodeId node) const {
            return decided[node.index() / 64] >> node.index() % 64 & 1;
        }
        void decide(NodeId node) {
            decided[node.index() / 64] |= std::uint64_t{1} << node.index() % 64;
        }

        // Bit of each node: set if further copies of the message have no effect at the node.
        std::vector<std::uint64_t> decided{};
        // Index + 1 of each node's entry in `waits`; 0 for a node without an entry.
        std::vector<std::uint32_t> wait_of{};
        std::vector<Wait> waits{};
        std::vector<Sender> senders{};
    };

    Known& known(const LinkLayer& link, MessageId message) {
        const std::size_t i = message.index(), nodes = link.size();
        if (i >= known_.size() || known_[i].size() < nodes) [[unlikely]]
            make_room(i, nodes);
        return known_[i];
    }
    void make_room(std::size_t message, std::size_t nodes);
    /// Whether copies after the first one can suppress the forwarding of a message.
    bool waits_matter() const { return settings_.scheme != SuppressionScheme::probability; }
    /// Whether the scheme uses the positions of the senders that a node hears.
    bool places_matter() const {
        return settings_.scheme == SuppressionScheme::distance ||
               settings_.scheme == SuppressionScheme::location;
    }
    void take(LinkLayer& link, const Heard& heard, Known& known, Reception& reception);
    bool hear_again(LinkLayer& link, const Heard& heard, Known& known, NodeId node);
    bool suppresses(LinkLayer& link, const Heard& heard, Known& known, Wait& wait, NodeId node);
    bool is_covered(const Heard& heard, Known& known, Wait& wait, Vec3 here);

    Suppression settings_;
    double threshold_;
    std::vector<Known> known_;   // state of each message in use, by message
    Sieve<Reception*> news_;     // receptions of a frame that may have an effect; kept for reuse
    std::vector<Vec3> senders_;  // positions of senders relative to a node [m]; kept for reuse
};

}  // namespace rovernet
