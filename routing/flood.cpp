// SPDX-License-Identifier: MIT
#include "routing/flood_router.hpp"
#include "routing/relay.hpp"

#include <algorithm>

namespace rovernet {

Flood::operator Router() const { return FloodRouter{*this}; }

FloodRouter::FloodRouter(const Flood& flood) : flood_(flood) { check_fields(flood, "flood"); }

/// Allocates the states of a message at all nodes.
void FloodRouter::make_room(std::size_t message, std::size_t nodes) {
    if (known_.size() <= message) known_.resize(message + 1);
    known_[message].resize(nodes, later_copies_matter());
}

/// TTL of a message; without a payload there is no first byte, and it starts with `ttl`.
Hops FloodRouter::initial_ttl(const Message& message) const {
    if (!flood_.ttl_in_payload || message.payload.empty()) return initial_ttl();
    return std::max<Hops>(static_cast<unsigned char>(message.payload.front()), 1);
}

void FloodRouter::send(LinkLayer& link, NodeId node, MessageId message) {
    Known& known = this->known(link, message);
    if (forwards_all()) {
        known[node] = Knowledge::ended;
    } else {
        known.settle(node);
    }
    link.send({.message = message,
               .sender = node,
               .path = link.key(node),
               .ttl = initial_ttl(link.message(message)),
               .hops = 1},
              std::nullopt, link.now());
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
            return is_duplicate(link, frame, r->node, known);
        });
    }
    sort_by_keys(link, {news.begin(), end});
    for (auto each = news.begin(); each != end; ++each) take(link, frame, known, **each);
}

/// Whether a copy at a node that is not settled is a duplicate, under "suppress" with `upgrade`:
/// the node then does not forward it. The copy may raise the TTL of a copy that the node has not
/// sent yet.
bool FloodRouter::is_duplicate(LinkLayer& link, const Frame& frame, NodeId node, Known& known) {
    const Knowledge mine = known[node];
    if (mine.is(Knowledge::unheard)) return false;
    if (!mine.is(Knowledge::waiting)) return frame.ttl <= 1;
    QueuedFrame* copy = link.waiting(mine.copy());
    if (!copy || copy->frame.message != frame.message || copy->frame.sender != node) {
        known.settle(node);  // it was sent
    } else if (frame.ttl - 1 > copy->frame.ttl) {
        *copy = passed_on(link, frame, node);
    }
    return true;
}

void FloodRouter::take(LinkLayer& link, const Frame& frame, Known& known, Reception& reception) {
    const NodeId node = reception.node;
    const bool forwards = frame.ttl > 1;
    reception.fate = forwards ? Fate::waiting : Fate::ttl;
    const SendHandle copy = forwards ? forward(link, frame, reception) : 0;
    if (!later_copies_matter()) {
        reception.delivered = true;
        known.settle(node);
        return;
    }
    Knowledge& mine = known[node];
    reception.delivered = mine.is(Knowledge::unheard);
    mine = forwards ? Knowledge{Knowledge::waiting, copy} : Knowledge::ended;
}

/// Schedules the forwarding of a copy, after its delay.
SendHandle FloodRouter::forward(LinkLayer& link, const Frame& frame, const Reception& reception) {
    // Under "suppress" a node sends a message once; otherwise copies of a message differ by their
    // path.
    const std::uint64_t which = forwards_all() ? frame.path : 0;
    const double u = link.draw(Purpose::flood_jitter, reception.node, frame.message, which);
    const Duration jitter = from_seconds(u * seconds(flood_.jitter));
    const QueuedFrame copy = passed_on(link, frame, reception.node);
    return link.send(copy.frame, copy.heard_from, reception.time + least_reaction + jitter).value();
}

void FloodRouter::forget(MessageId message) {
    if (message.index() < known_.size()) known_[message.index()] = {};  // and its memory
}

}  // namespace rovernet
