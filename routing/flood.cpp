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

/// For what every node knows of a message.
void FloodRouter::make_room(std::size_t message, std::size_t nodes) {
    if (known_.size() <= message) known_.resize(message + 1);
    known_[message].resize(nodes);
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
    const std::span<Knowledge> by_node = knowledge(link, frame.message);
    // Together, so that none waits for the one before; what few nodes know is in a cache anyway.
    constexpr std::size_t few = 4096;
    if (by_node.size() > few) {
        for (const auto& r : receptions) __builtin_prefetch(&by_node[r.node.index()]);
    }
    news_.clear();
    Reception** next = news_.room(receptions.size());
    const std::uint32_t first_settled = first_settled_, settled = settled_;
    for (auto& reception : receptions) {
        const Knowledge mine = by_node[reception.node.index()];
        reception.delivered = mine.is(Knowledge::unheard);
        reception.fate = Fate::duplicate;
        *next = &reception;
        next += !mine.is_among(first_settled, settled);
    }
    news_.keep_to(next);
    const std::span<Reception*> news = news_.kept();
    auto end = news.end();
    if (flood_.duplicates == Duplicates::suppress && flood_.upgrade) {
        end = std::remove_if(news.begin(), end, [&](const Reception* r) {
            return is_duplicate(frame, by_node[r->node.index()]);
        });
    }
    // Timers of one time are served in the order in which they were set.
    if (end - news.begin() > 1) {
        std::sort(news.begin(), end, [](const auto* a, const auto* b) { return *a < *b; });
    }
    for (auto each = news.begin(); each != end; ++each) {
        (*each)->fate = take(link, frame, **each, by_node[(*each)->node.index()]);
    }
}

/// Of those that are not settled, under "suppress" with `upgrade`: the node forwards no copy of its
/// own for this one, which may lift the one that it has not sent.
bool FloodRouter::is_duplicate(const Frame& frame, Knowledge known) {
    if (known.is(Knowledge::unheard)) return false;
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
    known_[heard.message.index()][node.index()] = Knowledge::sent;
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
