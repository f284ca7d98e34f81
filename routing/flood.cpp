// SPDX-License-Identifier: MIT
#include "routing/flood.hpp"

namespace rovernet {

Flood::operator Router() const { return FloodRouter{*this}; }

FloodRouter::FloodRouter(const Flood& flood) : flood_(flood) { check_fields(flood, "flood"); }

/// What every node knows of a message.
std::vector<FloodRouter::Knowledge>& FloodRouter::knowledge(const LinkLayer& link,
                                                            MessageId message) {
    if (known_.size() <= message.index()) known_.resize(message.index() + 1);
    auto& by_node = known_[message.index()];
    if (by_node.size() < link.size()) by_node.resize(link.size());
    return by_node;
}

void FloodRouter::send(LinkLayer& link, NodeId node, MessageId message) {
    knowledge(link, message)[node.index()] = Knowledge::sent;
    link.broadcast({.message = message,
                    .sender = node,
                    .path = link.key(node),
                    .ttl = initial_ttl(),
                    .hops = 1},
                   std::nullopt);
}

void FloodRouter::on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions) {
    auto& by_node = knowledge(link, frame.message);
    // Together, so that none waits for the one before.
    for (const auto& reception : receptions) __builtin_prefetch(&by_node[reception.node.index()]);
    for (auto& reception : receptions) {
        Knowledge& mine = by_node[reception.node.index()];
        reception.delivered = mine.is(Knowledge::unheard);
        reception.fate = fate_of(link, frame, reception, mine);
    }
}

Fate FloodRouter::fate_of(LinkLayer& link, const Frame& frame, const Reception& reception,
                          Knowledge& mine) {
    const bool last_hop = frame.ttl <= 1;
    if (flood_.duplicates == Duplicates::forward) {
        if (mine.is(Knowledge::unheard)) mine = Knowledge::ended;
        if (last_hop) return Fate::ttl;
        wait(link, frame, reception);
        return Fate::waiting;
    }
    if (!mine.is(Knowledge::unheard)) {
        if (!flood_.upgrade || !lifts(frame, mine)) return Fate::duplicate;
        if (mine.is(Knowledge::waiting)) {
            copies_[mine.copy()] = frame;
            return Fate::duplicate;
        }
    }
    if (last_hop) {
        mine = Knowledge::ended;
        return Fate::ttl;
    }
    mine = {Knowledge::waiting, wait(link, frame, reception)};
    return Fate::waiting;
}

/// Whether a late copy has a higher TTL than the one that the node has not sent.
bool FloodRouter::lifts(const Frame& frame, const Knowledge& known) const {
    if (known.is(Knowledge::sent)) return false;
    const int ttl = known.is(Knowledge::waiting) ? copies_[known.copy()].ttl : 1;
    return frame.ttl > ttl;
}

/// Keeps a copy for its delay; returns where.
std::uint32_t FloodRouter::wait(LinkLayer& link, const Frame& frame, const Reception& reception) {
    const auto copy = static_cast<std::uint32_t>(copies_.take());
    copies_[copy] = frame;
    link.hold(frame.message);
    // A node sends one message once under "suppress"; copies of one message differ by their path.
    const std::uint64_t which = flood_.duplicates == Duplicates::forward ? frame.path : 0;
    const double u = link.draw(Purpose::flood_jitter, reception.node, frame.message, which);
    const Duration jitter = from_seconds(u * seconds(flood_.jitter));
    link.timer(reception.node, reception.time + least_reaction + jitter, copy);
    return copy;
}

void FloodRouter::on_timer(LinkLayer& link, NodeId node, std::uint64_t copy) {
    const Frame heard = copies_[copy];
    copies_.release(copy);
    knowledge(link, heard.message)[node.index()] = Knowledge::sent;
    if (link.is_on(node)) {
        link.broadcast({.message = heard.message,
                        .sender = node,
                        .path = combine(heard.path, link.key(node)),
                        .ttl = static_cast<Hops>(heard.ttl - 1),
                        .hops = static_cast<Hops>(heard.hops + 1)},
                       heard.sender);
    } else {
        link.drop(node, heard, DropReason::off);
    }
    link.release(heard.message);
}

void FloodRouter::forget(MessageId message) {
    if (message.index() < known_.size()) known_[message.index()] = {};  // and its memory
}

}  // namespace rovernet
