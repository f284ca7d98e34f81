// SPDX-License-Identifier: MIT
#pragma once

#include "routing/suppression.hpp"
#include "sim/sieve.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace rovernet {

/// Routing protocol of a Suppression, except for scheme "cluster" (ClusterRouter). For each message
/// in use it stores a bit per node; except for scheme "probability", four bytes more, and eight
/// bytes per node that waits or waited; for "location" also the place of each sender that such a
/// node heard.
///
/// All schemes are monotone: further copies only add reasons not to forward. So a waiting copy is
/// cancelled at the copy that decides, in place of at the end of the delay.
class SuppressionRouter {
  public:
    /// @throws std::invalid_argument if a parameter is out of its range, or of its scheme's range
    explicit SuppressionRouter(const Suppression& suppression);

    Hops initial_ttl() const { return static_cast<Hops>(settings_.ttl); }
    void send(LinkLayer& link, NodeId node, MessageId message);
    void on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions);
    void forget(MessageId message);

  private:
    /// Frame that nodes hear, and where its sender is, if places_matter().
    struct Heard {
        const Frame& frame;
        Vec3 from;
    };
    /// Wait of a node for the send time of its copy.
    struct Wait {
        SendHandle copy = 0;
        /// Copies heard so far.
        std::uint32_t copies = 0;
        /// Number of the last sender heard in Known::senders, from 1, for "location".
        std::uint32_t last_sender = 0;
    };
    /// Sender that a node heard, and the one that it heard before, or 0.
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

        // Bit of each node for which further copies change nothing.
        std::vector<std::uint64_t> decided{};
        // Number of each node's entry in `waits`, from 1; 0 for a node that has heard nothing.
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
    /// Whether copies after the first one matter.
    bool waits_matter() const { return settings_.scheme != SuppressionScheme::probability; }
    /// Whether a node knows where the senders are that it hears.
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
    std::vector<Known> known_;   // states by message
    Sieve<Reception*> news_;     // copies of one frame that may matter; memory for reuse
    std::vector<Vec3> senders_;  // senders around a node, memory for reuse
};

}  // namespace rovernet
