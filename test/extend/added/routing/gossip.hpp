// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "sim/router.hpp"

#include <set>
#include <string_view>
#include <utility>

namespace rovernet {

/// Routing protocol "gossip": a robot forwards a message at most once, with probability p, after 1
/// us + U(0, jitter).
///
/// Source: Z. Haas, J. Halpern, L. Li, Gossip-based ad hoc routing, INFOCOM 2002.
struct Gossip {
    static constexpr std::string_view name = "gossip";

    double probability = 0.7;                         ///< p [-], 0 ... 1
    Duration jitter = std::chrono::milliseconds{10};  ///< longest random delay [ns]

    static constexpr auto fields() {
        return describe(field("probability", &Gossip::probability,
                              Range{.low = 0, .high = 1, .text = "from 0 to 1"}, "of forwarding"),
                        field("jitter", &Gossip::jitter, non_negative, "before forwarding"));
    }

    operator Router() const;
};

/// Routing protocol with the parameters of a Gossip.
class GossipRouter {
  public:
    /// @throws std::invalid_argument if a parameter is out of its range
    explicit GossipRouter(const Gossip& gossip);

    Hops initial_ttl() const { return 64; }
    void send(LinkLayer& link, NodeId node, MessageId message);
    void on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions);

  private:
    Gossip gossip_;
    // pairs of a node and the uid of a message that the node has received
    std::set<std::pair<NodeId, std::uint64_t>> heard_;
};

}  // namespace rovernet
