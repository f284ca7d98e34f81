// SPDX-License-Identifier: MIT
#include "routing/gossip.hpp"

namespace rovernet {

Gossip::operator Router() const { return GossipRouter{*this}; }

GossipRouter::GossipRouter(const Gossip& gossip) : gossip_(gossip) {
    check_fields(gossip, Gossip::name);
}

void GossipRouter::send(LinkLayer& link, NodeId node, MessageId message) {
    heard_.insert({node, link.message(message).uid});
    const Frame frame{.message = message, .sender = node, .ttl = initial_ttl(), .hops = 1};
    link.send(frame, std::nullopt, link.now());
}

void GossipRouter::on_receive(LinkLayer& link, const Frame& frame,
                              std::span<Reception> receptions) {
    for (Reception& r : receptions) {
        r.delivered = heard_.insert({r.node, link.message(frame.message).uid}).second;
        const auto draw = [&](std::uint64_t index) {
            return link.draw(Purpose::routing_jitter, r.node, frame.message, index);
        };
        const bool forwards = frame.ttl > 1 && draw(0) < gossip_.probability;
        r.fate = !r.delivered ? Fate::duplicate : forwards ? Fate::waiting : Fate::ttl;
        if (r.fate != Fate::waiting) continue;
        Frame copy = frame;
        copy.sender = r.node;
        --copy.ttl;
        ++copy.hops;
        const Duration delay = from_seconds(draw(1) * seconds(gossip_.jitter));
        link.send(copy, frame.sender, r.time + least_reaction + delay);
    }
}

}  // namespace rovernet
