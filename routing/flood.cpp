// SPDX-License-Identifier: MIT
#include "routing/flood.hpp"

#include <algorithm>

namespace rovernet {

Flood::operator Router() const { return FloodRouter{*this}; }

FloodRouter::FloodRouter(const Flood& flood) : flood_(flood) { check_fields(flood, "flood"); }

/// For what every node knows of a message.
void FloodRouter::make_room(std::size_t message, std::size_t nodes) {
    if (known_.size() <= message) known_.resize(message + 1);
    known_[message].resize(nodes, later_copies_matter());
}

void FloodRouter::send(LinkLayer& link, NodeId node, MessageId message) {
    Known& known = this->known(link, message);
    if (forwards_all()) {
        known[node] = Knowledge::ended;
    } else {
        known.settle(node);
    }
    link.broadcast({.message = message,
                    .sender = node,
                    .path = link.key(node),
                    .ttl = initial_ttl(),
                    .hops = 1},
                   std::nullopt);
}

void FloodRouter::on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions) {
    Known& known = this->known(link, frame.message);
    news_.clear();
    Reception** next = news_.room(receptions.size());
    for (auto& reception : receptions) {
        reception.delivered = false;
        reception.fate = Fate::duplicate;
        *next = &reception;
        next += !known.is_settled(reception.node);
    }
    news_.keep_to(next);
    const std::span<Reception*> news = news_.kept();
    auto end = news.end();
    if (!forwards_all() && flood_.upgrade) {
        end = std::remove_if(news.begin(), end, [&](const Reception* r) {
            return is_duplicate(frame, known[r->node]);
        });
    }
    // Timers of one time are served in the order in which they were set: in that of the nodes'
    // keys, so that their numbers decide nothing.
    if (end - news.begin() > 1) {
        std::sort(news.begin(), end, [&](const auto* a, const auto* b) {
            return a->time != b->time ? a->time < b->time : link.key(a->node) < link.key(b->node);
        });
    }
    for (auto each = news.begin(); each != end; ++each) take(link, frame, known, **each);
}

/// Of those that are not settled, under "suppress" with `upgrade`: the node forwards no copy of its
/// own for this one, which may lift the one that it has not sent.
bool FloodRouter::is_duplicate(const Frame& frame, Knowledge mine) {
    if (mine.is(Knowledge::unheard)) return false;
    if (!mine.is(Knowledge::waiting)) return frame.ttl <= 1;
    Frame& copy = copies_[mine.copy()];
    if (frame.ttl > copy.ttl) copy = frame;
    return true;
}

void FloodRouter::take(LinkLayer& link, const Frame& frame, Known& known, Reception& reception) {
    const NodeId node = reception.node;
    const bool forwards = frame.ttl > 1;
    reception.fate = forwards ? Fate::waiting : Fate::ttl;
    const std::uint32_t copy = forwards ? wait(link, frame, reception) : 0;
    if (!later_copies_matter()) {
        reception.delivered = true;
        known.settle(node);
        return;
    }
    Knowledge& mine = known[node];
    reception.delivered = mine.is(Knowledge::unheard);
    mine = forwards ? Knowledge{Knowledge::waiting, copy} : Knowledge::ended;
}

/// Keeps a copy for its delay; returns where.
std::uint32_t FloodRouter::wait(LinkLayer& link, const Frame& frame, const Reception& reception) {
    const auto copy = static_cast<std::uint32_t>(copies_.take());
    copies_[copy] = frame;
    link.hold(frame.message);
    // A node sends one message once under "suppress"; copies of one message differ by their path.
    const std::uint64_t which = forwards_all() ? frame.path : 0;
    const double u = link.draw(Purpose::flood_jitter, reception.node, frame.message, which);
    const Duration jitter = from_seconds(u * seconds(flood_.jitter));
    link.timer(reception.node, reception.time + least_reaction + jitter, copy);
    return copy;
}

void FloodRouter::on_timer(LinkLayer& link, NodeId node, std::uint64_t copy) {
    const Frame heard = copies_[copy];
    copies_.release(copy);
    if (!forwards_all()) known_[heard.message.index()].settle(node);
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
