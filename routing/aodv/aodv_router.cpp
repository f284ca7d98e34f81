// SPDX-License-Identifier: MIT
#include "routing/aodv/aodv_router.hpp"

#include "routing/in_order.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace rovernet {
Aodv::operator Router() const { return AodvRouter{AodvRules::of(*this)}; }

Time AodvRouter::RateLimit::take(Time now) {
    constexpr std::size_t most = 10;
    constexpr Duration window = std::chrono::seconds{1};
    if (last_.size() == most) {
        if (now < last_.front() + window) return last_.front() + window;
        last_.erase(last_.begin());
    }
    last_.push_back(now);
    return now;
}

void AodvRouter::make_room(NodeId node) {
    // An eighth more than needed: a node takes 600 bytes, and std::vector would double its
    // capacity.
    const std::size_t needed = node.index() + std::size_t{1};
    if (needed > nodes_.capacity()) nodes_.reserve(needed + needed / 8);
    while (nodes_.size() <= node.index()) nodes_.emplace_back().number = rules_.first_number;
}

Route* AodvRouter::route(NodeId at, NodeId destination, Time now) {
    return node(at).routes.find(destination, now, rules_.delete_period);
}

Route* AodvRouter::valid_route(NodeId at, NodeId destination, Time now) {
    Route* found = route(at, destination, now);
    return found && found->is_valid ? found : nullptr;
}

/// Lengthens the lifetime of a route in use (6.2).
void AodvRouter::refresh(NodeId at, NodeId destination, Time now) {
    Route* used = valid_route(at, destination, now);
    if (used) used->until = std::max(used->until, now + rules_.active_route_timeout);
}

/// Lengthens the lives of the route to a destination and of that to its next hop, as a message is
/// sent along them (6.2).
void AodvRouter::use(NodeId at, NodeId destination, NodeId next_hop, Time now) {
    refresh(at, destination, now);
    if (rules_.meets_neighbours) refresh(at, next_hop, now);
    node(at).active_until = now + rules_.active_route_timeout;
}

std::vector<RouteState> AodvRouter::routes(NodeId at, Time now) const {
    std::vector<RouteState> all;
    if (at.index() >= nodes_.size()) return all;
    RouteTable table = nodes_[at.index()].routes;
    table.for_each(now, rules_.delete_period, [&](const Route& each) {
        all.push_back({.destination = each.destination,
                       .next_hop = each.next_hop,
                       .hops = each.hops,
                       .number = each.has_number ? std::optional{each.number} : std::nullopt,
                       .is_valid = each.is_valid,
                       .since = each.since,
                       .until = each.until});
    });
    return all;
}

void AodvRouter::forget(MessageId message) {
    if (message.index() < arrived_.size()) arrived_[message.index()] = false;
}

bool AodvRouter::keeps(MessageId message) const {
    return std::any_of(nodes_.begin(), nodes_.end(), [&](const Node& each) {
        const auto& packets = each.buffer.packets();
        return std::any_of(packets.begin(), packets.end(),
                           [&](const auto& p) { return p.queued.frame.message == message; });
    });
}

void AodvRouter::on_start(LinkLayer& link, NodeId at) {
    Node& here = node(at);
    if (rules_.hello == Duration{0} || std::exchange(here.is_started, true)) return;
    const double u = link.draw(Purpose::hello, at, 0);
    link.timer(at, link.now() + from_seconds(u * seconds(rules_.hello)), Tag::hello);
}

/// A node that is switched off loses what it knows, and begins in silence (6.13).
void AodvRouter::on_switched(LinkLayer& link, NodeId at, bool on) {
    Node& here = node(at);
    if (on) {
        if (here.was_off) here.silent_until = link.now() + rules_.silence;
        return;
    }
    for (const auto& packet : here.buffer.take_all()) lose(link, at, packet, DropReason::off);
    const bool is_started = here.is_started;
    here = {};
    here.number = rules_.first_number;
    here.is_started = is_started;
    here.was_off = true;
}

void AodvRouter::send(LinkLayer& link, NodeId at, MessageId id) {
    const Message& message = link.message(id);
    const NodeId to = message.to;
    QueuedFrame own{.frame = {.message = id,
                              .sender = at,
                              .path = link.key(at),
                              .ttl = initial_ttl(message),
                              .hops = 1,
                              .bytes = message.size + rules_.data_header}};
    const Time now = link.now();
    if (to == everyone) {
        link.send(own.frame, {}, now);
        return;
    }
    if (const Route* known = valid_route(at, to, now)) {
        const NodeId next_hop = known->next_hop;  // use() may remove entries
        use(at, to, next_hop, now);
        return send_on(link, own, next_hop, now);
    }
    keep(link, at, to, own, now);
    search(link, at, to, now);
}

void AodvRouter::send_on(LinkLayer& link, const QueuedFrame& queued, NodeId next_hop, Time at) {
    Frame frame = queued.frame;
    frame.next_hop = next_hop;
    link.send(frame, queued.heard_from, at);
}

/// Lets a packet wait for a route; set_timer() is to follow.
void AodvRouter::keep(LinkLayer& link, NodeId at, NodeId to, const QueuedFrame& queued, Time now) {
    link.hold(queued.frame);
    const auto oldest =
        node(at).buffer.add({to, queued, now + SendBuffer::longest_wait}, rules_.buffer);
    if (oldest) lose(link, at, *oldest, DropReason::buffer_full);
}

/// Ends a packet that waited.
void AodvRouter::lose(LinkLayer& link, NodeId at, const SendBuffer::Packet& packet,
                      DropReason reason) {
    link.drop(at, packet.queued.as_received(), reason);
    link.release(packet.queued.frame);
}

void AodvRouter::on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions) {
    const Message& message = link.message(frame.message);
    if (message.kind.empty()) {
        return in_order(link, receptions,
                        [&](Reception& each) { receive_message(link, frame, each); });
    }
    const bool message_is_hello = message.kind == aodv::hello_kind;
    const aodv::Packet packet = aodv::packet_of(message.payload);
    if (const auto* request = std::get_if<aodv::Request>(&packet)) {
        prefetch(receptions, frame.sender, request->originator);
    }
    in_order(link, receptions, [&](Reception& each) {
        each.fate = Fate::arrived;
        hear(each.node, frame.sender, each.time, message_is_hello);
        if (const auto* request = std::get_if<aodv::Request>(&packet)) {
            each.fate = receive_request(link, frame, *request, each);
        } else if (const auto* reply = std::get_if<aodv::Reply>(&packet)) {
            each.fate = receive_reply(link, frame, *reply, each);
        } else if (const auto* error = std::get_if<aodv::Error>(&packet)) {
            receive_error(link, frame, *error, each);
        }
    });
}

/// Fetches what receive_request() reads at each receiver into the processor's cache. Among
/// thousands of nodes, each receiver would otherwise wait for its node, then for its routes.
void AodvRouter::prefetch(std::span<const Reception> receptions, NodeId from, NodeId originator) {
    constexpr std::size_t cache_line = 64;
    for (const Reception& each : receptions) {
        const auto* const first = reinterpret_cast<const std::byte*>(&node(each.node));
        for (std::size_t i = 0; i < sizeof(Node); i += cache_line) __builtin_prefetch(first + i);
    }
    for (const Reception& each : receptions) {
        const Node& receiver = nodes_[each.node.index()];
        receiver.routes.prefetch(from);
        receiver.seen.prefetch(originator);
    }
}

void AodvRouter::receive_message(LinkLayer& link, const Frame& frame, Reception& r) {
    const NodeId at = r.node;
    const Message& message = link.message(frame.message);
    const NodeId to = message.to, origin = message.origin;
    r.fate = Fate::arrived;
    r.delivered = to == everyone;
    hear(at, frame.sender, r.time, false);
    if (to == everyone) return;
    // 6.2: a packet lengthens the lives of four routes.
    if (rules_.meets_neighbours) {
        refresh(at, origin, r.time);
        refresh(at, frame.sender, r.time);
    }
    if (to == at) {
        node(at).active_until = r.time + rules_.active_route_timeout;
        const std::size_t i = frame.message.index();
        if (i >= arrived_.size()) arrived_.resize(i + 1);
        r.delivered = !arrived_[i];
        if (arrived_[i]) r.fate = Fate::duplicate;
        arrived_[i] = true;
        return;
    }
    r.fate = frame.ttl > 1 ? Fate::waiting : Fate::ttl;
    if (frame.ttl <= 1) return;
    QueuedFrame onward{.frame = frame, .heard_from = frame.sender};
    onward.frame.sender = at;
    onward.frame.path = combine(frame.path, link.key(at));
    --onward.frame.ttl;
    ++onward.frame.hops;
    if (const Route* known = valid_route(at, to, r.time)) {
        const NodeId next_hop = known->next_hop;  // use() may remove entries
        use(at, to, next_hop, r.time);
        return send_on(link, onward, next_hop, r.time + least_reaction);
    }
    if (is_repaired(at, to)) {
        keep(link, at, to, onward, r.time);
        return set_timer(link, at);
    }
    refuse(link, frame, to, r);
}

void AodvRouter::on_sent(LinkLayer& link, const QueuedFrame& queued, SendResult result) {
    const NodeId at = queued.frame.sender, next_hop = queued.frame.next_hop;
    if (result == SendResult::acked || result == SendResult::sent) return;
    const Message& message = link.message(queued.frame.message);
    if (result != SendResult::retries) {
        if (!message.kind.empty()) return;
        return link.drop(at, queued.as_received(), drop_reason_of(result));
    }
    if (message.kind == aodv::reply_kind && rules_.blacklist_timeout > Duration{0}) {
        node(at).one_way.push_back({next_hop, link.now()});
    }
    std::vector<QueuedFrame> stranded = link.take_queued(at, next_hop);
    stranded.insert(stranded.begin(), queued);
    on_broken(link, at, next_hop, stranded);
    for (std::size_t i = 1; i < stranded.size(); ++i) link.release(stranded[i].frame);
}

Duration AodvRouter::jitter(LinkLayer& link, NodeId at, MessageId message) const {
    return from_seconds(link.draw(Purpose::routing_jitter, at, message, 0) *
                        seconds(rules_.jitter));
}

void AodvRouter::on_timer(LinkLayer& link, NodeId at, std::uint64_t tag) {
    const Time now = link.now();
    if (tag == Tag::hello) link.timer(at, now + rules_.hello, Tag::hello);
    if (tag != Tag::searches) {
        if (!link.is_on(at)) return;
        if (tag == Tag::hello) send_hello(link, at);
        return end_silent(link, at);
    }
    if (node(at).timer != now) return;  // an earlier one was set since
    node(at).timer.reset();
    for (const auto& packet : node(at).buffer.take_expired(now)) {
        lose(link, at, packet, DropReason::timeout);
    }
    auto& all = node(at).searches;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (due(all[i]) <= now) proceed(link, at, all[i], now);
    }
    set_timer(link, at);
}

}  // namespace rovernet
