// SPDX-License-Identifier: MIT
#include "routing/flood.hpp"

#include <algorithm>

namespace rovernet {

Flood::operator Router() const { return FloodRouter{*this}; }

FloodRouter::FloodRouter(const Flood& flood) : flood_(flood) {
    check_fields(flood, "flood");
    if (flood.duplicates == Duplicates::forward) return;
    settled_ = 1;
    if (flood.upgrade) return;
    first_settled_ = Knowledge::ended;
    settled_ = ~std::uint32_t{0};
}

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
    Knowledge* const by_node = knowledge(link, frame.message).data();
    // Together, so that none waits for the one before.
    for (const auto& reception : receptions) __builtin_prefetch(&by_node[reception.node.index()]);
    news_.clear();
    for (auto& reception : receptions) {
        const Knowledge mine = by_node[reception.node.index()];
        reception.delivered = mine.is(Knowledge::unheard);
        reception.fate = Fate::duplicate;
        news_.put(&reception, !mine.is_among(first_settled_, settled_));
    }
    const std::span<Reception*> news = news_.kept();
    const auto end = std::remove_if(news.begin(), news.end(), [&](const Reception* r) {
        return is_duplicate(frame, by_node[r->node.index()]);
    });
    // Timers of one time are served in the order in which they were set.
    std::sort(news.begin(), end, [](const Reception* a, const Reception* b) { return *a < *b; });
    for (auto each = news.begin(); each != end; ++each) {
        (*each)->fate = take(link, frame, **each, by_node[(*each)->node.index()]);
    }
}

/// Of those that are not settled: the node forwards no copy of its own for this one, which may
/// lift the one that it has not sent.
bool FloodRouter::is_duplicate(const Frame& frame, Knowledge known) {
    if (flood_.duplicates == Duplicates::forward || known.is(Knowledge::unheard)) return false;
    if (!known.is(Knowledge::waiting)) return frame.ttl <= 1;
    Frame& copy = copies_[known.copy()];
    if (frame.ttl > copy.ttl) copy = frame;
    return true;
}

Fate FloodRouter::take(LinkLayer& link, const Frame& frame, const Reception& reception,
                       Knowledge& mine) {
    if (mine.is(Knowledge::unheard)) mine = Knowledge::ended;
    if (frame.ttl <= 1) return Fate::ttl;
    const std::uint32_t copy = wait(link, frame, reception);
    if (flood_.duplicates == Duplicates::suppress) mine = {Knowledge::waiting, copy};
    return Fate::waiting;
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
