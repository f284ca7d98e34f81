// SPDX-License-Identifier: MIT
#include "routing/dsr/dsr_router.hpp"

#include <algorithm>
#include <chrono>

// Routes of DSR: what nodes learn from packets, requests and replies, and the waits between them.
// Sections are those of RFC 4728.

namespace rovernet {
namespace {

using dsr::Path;
using namespace std::chrono_literals;

// Constants of section 9.
constexpr Duration nonpropagating_wait = 30ms, first_wait = 500ms, longest_backoff = 10s;
constexpr int most_requests = 16;  // beside the one that goes to the neighbours alone
constexpr Duration shortening_hold_off = 1s;
// Time for which a node remembers the requests of an originator.
constexpr Duration request_memory = 300s;
// Age up to which a reported link is passed on with a request, as in ns-2.
constexpr Duration error_age = 1s;
constexpr Hops farthest = 32;

/// Path with the nodes of another one from place `from` on, as many as there is room for.
Path joined(Path path, const Path& other, std::size_t from) {
    for (std::size_t i = from; i < other.size() && !path.is_full(); ++i) path.add(other[i]);
    return path;
}

bool has_repetition(const Path& path) {
    for (std::size_t i = 0; i < path.size(); ++i) {
        if (path.place(path[i]) != i) return true;
    }
    return false;
}

}  // namespace

/// Takes both directions of a route that a node sees in a packet: from its own place on the route,
/// or over the neighbour that sent the packet (3.3.1). Links work in both directions.
void DsrRouter::learn(NodeId at, NodeId sender, const Path& path, dsr::Cache::Origin origin,
                      Time now) {
    const std::size_t mine = path.place(at);
    const std::size_t place = mine < path.size() ? mine : path.place(sender);
    if (place == path.size()) return;
    const Path start = mine < path.size() ? Path{} : Path{at};
    dsr::Cache& cache = node(at).cache;
    cache.add(joined(start, path, place), origin, now);
    cache.add(joined(start, path.first(place + 1).reversed(), 0), dsr::Cache::Origin::others, now);
}

/// Tells the source of an overheard message that its route may leave out the nodes between the
/// sender and this node (3.4.3).
void DsrRouter::shorten(LinkLayer& link, NodeId sender, Way way, const Reception& r) {
    const NodeId at = r.node;
    const std::size_t mine = way.path.place(at);
    if (mine == way.path.size() || mine <= way.sender + 1) return;
    const NodeId source = way.path.front();
    auto& sent = node(at).shortenings;
    std::erase_if(sent, [&](const Shortening& each) { return each.until <= r.time; });
    if (std::any_of(sent.begin(), sent.end(), [&](const Shortening& each) {
            return each.source == source && each.sender == sender;
        })) {
        return;
    }
    sent.push_back({source, sender, r.time + shortening_hold_off});
    Path to_here = way.path.first(way.sender + 1);
    to_here.add(at);
    const dsr::Reply shorter{joined(to_here, way.path, mine + 1)};
    send_packet(link, at, {.reply = shorter, .route = to_here.reversed()}, dsr::reply_kind,
                r.time + least_reaction);
}

/// Receives a control packet, at a node of its route or at one that overhears it.
void DsrRouter::receive_control(LinkLayer& link, const Frame& frame, const dsr::Packet& packet,
                                Reception& r) {
    const NodeId at = r.node;
    Node& here = node(at);
    if (const auto& error = packet.error) {  // 8.3.5
        here.cache.remove_link(error->from, error->unreachable);
        if (error->to == at) {
            here.error = error;
            here.error_time = r.time;
        }
    }
    if (packet.request) r.fate = receive_request(link, frame, packet, r);
    if (const auto& reply = packet.reply) {  // 8.2.6
        const bool is_own = reply->path.front() == at;
        learn(at, frame.sender, reply->path,
              is_own ? dsr::Cache::Origin::own : dsr::Cache::Origin::others, r.time);
    }
    if (packet.route) {
        learn(at, frame.sender, *packet.route, dsr::Cache::Origin::others, r.time);
        const bool is_last = packet.route->back() == at;
        const Way way{*packet.route, frame.hops - std::size_t{1}};
        if (frame.next_hop == at && !is_last) receive_on(link, frame, way, r);
    }
    end_searches(link, at, r.time + least_reaction);
}

/// Receives a request (8.2.2). The target answers each copy (8.2.4), others answer with a route
/// that they know, or pass the request on.
Fate DsrRouter::receive_request(LinkLayer& link, const Frame& frame, const dsr::Packet& packet,
                                const Reception& r) {
    const NodeId at = r.node;
    const dsr::Request& asked = *packet.request;
    Node& here = node(at);
    if (asked.path.has(at) || asked.path.is_full()) return Fate::duplicate;
    Path to_here = asked.path;
    to_here.add(at);
    const Path back = to_here.reversed();
    here.cache.add(back, dsr::Cache::Origin::others, r.time);
    const Time soon = r.time + least_reaction;
    if (asked.target == at) {
        send_packet(link, at, {.reply = dsr::Reply{to_here}, .route = back}, dsr::reply_kind,
                    soon + jitter(link, at, frame.message));
        return Fate::arrived;
    }
    if (!here.seen.note16(asked.path.front(), asked.id, r.time, request_memory)) {
        return Fate::duplicate;
    }
    if (const auto known = here.cache.find(asked.target)) {  // 8.2.3
        const Path whole = joined(to_here, *known, 1);
        if (whole.back() == asked.target && !has_repetition(whole)) {
            send_packet(link, at, {.reply = dsr::Reply{whole}, .route = back}, dsr::reply_kind,
                        soon);
            return Fate::arrived;
        }
    }
    if (frame.ttl <= 1) return Fate::ttl;
    if (to_here.is_full()) {  // no room for the target
        too_far_[{asked.path.front(), asked.target}].last = r.time;
        return Fate::ttl;
    }
    pass_on(link, frame,
            {.request = dsr::Request{asked.id, asked.target, to_here}, .error = packet.error}, r);
    return Fate::waiting;
}

/// Passes a request on, with the own address in its list.
void DsrRouter::pass_on(LinkLayer& link, const Frame& frame, const dsr::Packet& packet,
                        const Reception& r) {
    const NodeId at = r.node;
    Frame onward = frame;
    onward.sender = at;
    onward.path = combine(frame.path, link.key(at));
    --onward.ttl;
    ++onward.hops;
    send_request(link, onward, packet, frame.sender,
                 r.time + least_reaction + jitter(link, at, frame.message));
}

/// Sends a packet along the route that it has.
void DsrRouter::send_packet(LinkLayer& link, NodeId at, const dsr::Packet& packet,
                            std::string_view kind, Time when) {
    const Path& route = *packet.route;
    const std::string bytes = dsr::to_bytes(packet);
    const auto size = static_cast<std::uint32_t>(dsr::ip_header + bytes.size());
    const MessageId id = link.originate(at, route.back(), kind, size, bytes);
    link.send({.message = id,
               .sender = at,
               .path = link.key(at),
               .ttl = 255,
               .hops = 1,
               .next_hop = route[1]},
              {}, when);
    link.release(id);
}

/// Sends a request to everyone: a packet of its originator for its target.
void DsrRouter::send_request(LinkLayer& link, Frame frame, const dsr::Packet& packet,
                             std::optional<NodeId> heard_from, Time when) {
    const std::string bytes = dsr::to_bytes(packet);
    const auto size = static_cast<std::uint32_t>(dsr::ip_header + bytes.size());
    frame.message = link.originate(packet.request->path.front(), packet.request->target,
                                   dsr::request_kind, size, bytes);
    link.send(frame, heard_from, when);
    link.release(frame.message);
}

/// Starts a search for a target to which a packet waits, or goes on with one whose wait is over.
void DsrRouter::search(LinkLayer& link, NodeId at, NodeId target, Time when) {
    auto& all = node(at).searches;
    auto found = std::find_if(all.begin(), all.end(),
                              [&](const Search& each) { return each.target == target; });
    if (found == all.end()) found = all.insert(all.end(), Search{.target = target});
    if (found->until <= when) proceed(link, at, *found, when);
    set_timer(link, at);
}

/// Whether messages of the node's own wait for a route. For others it asks its neighbours alone.
bool DsrRouter::has_own(NodeId at, NodeId target) {
    const auto& packets = node(at).buffer.packets();
    return std::any_of(packets.begin(), packets.end(), [&](const SendBuffer::Packet& each) {
        return each.destination == target && !each.queued.heard_from;
    });
}

/// Sends the next request for the messages that wait, or gives up.
void DsrRouter::proceed(LinkLayer& link, NodeId at, Search& search, Time when) {
    if (search.requests <= most_requests) return request(link, at, search, when);
    for (const auto& packet : node(at).buffer.take(search.target)) {
        lose(link, at, packet, DropReason::no_route);
    }
}

/// Sends the next request of a search (8.2.1): the first one to the neighbours alone.
void DsrRouter::request(LinkLayer& link, NodeId at, Search& search, Time when) {
    Node& here = node(at);
    const bool is_own = has_own(at, search.target);
    const bool propagates = search.requests > 0 && is_own;
    dsr::Packet packet{.request = dsr::Request{++here.request, search.target, Path{at}}};
    if (propagates && here.error && when - here.error_time <= error_age) packet.error = here.error;
    if (propagates) here.error.reset();
    send_request(link,
                 {.message = {},
                  .sender = at,
                  .path = link.key(at),
                  .ttl = propagates ? farthest : Hops{1},
                  .hops = 1},
                 packet, {}, when);
    search.until = when + nonpropagating_wait;
    if (propagates) {  // 4.3: the waits grow until a route is found
        search.until = when + std::min(first_wait * (1 << search.doublings), longest_backoff);
        search.doublings = std::min(search.doublings + 1, 10);
    }
    search.requests += is_own;
}

/// Ends the searches for targets to which there is a route, and sends what waited.
void DsrRouter::end_searches(LinkLayer& link, NodeId at, Time when) {
    Node& here = node(at);
    for (std::size_t i = 0; i < here.searches.size();) {
        const NodeId target = here.searches[i].target;
        const auto path = here.cache.find(target);
        if (!path) {
            ++i;
            continue;
        }
        here.searches.erase(here.searches.begin() + static_cast<std::ptrdiff_t>(i));
        Time then = when;
        for (const auto& packet : here.buffer.take(target)) {
            send_along(link, packet.queued, *path, salvage_of(packet.queued), then);
            then += link.spacing(packet.queued.frame);
            link.release(packet.queued.frame);
        }
    }
}

/// Sets the timer for the first search that goes on, or the first packet that has waited too long.
void DsrRouter::set_timer(LinkLayer& link, NodeId at) {
    Node& here = node(at);
    std::optional<Time> next = here.buffer.first_end();
    for (const Search& each : here.searches) {
        if (has_own(at, each.target)) next = std::min(next.value_or(each.until), each.until);
    }
    if (!next || (here.timer && *here.timer <= *next)) return;
    here.timer = std::max(*next, link.now() + least_reaction);
    link.timer(at, *here.timer, 0);
}

void DsrRouter::on_timer(LinkLayer& link, NodeId at, std::uint64_t) {
    const Time now = link.now();
    Node& here = node(at);
    if (here.timer != now) return;  // an earlier one was set since
    here.timer.reset();
    for (const auto& packet : here.buffer.take_expired(now)) {
        lose(link, at, packet, DropReason::timeout);
    }
    for (std::size_t i = 0; i < here.searches.size(); ++i) {
        Search& each = here.searches[i];
        if (each.until <= now && has_own(at, each.target)) proceed(link, at, each, now);
    }
    set_timer(link, at);
}

Duration DsrRouter::jitter(LinkLayer& link, NodeId at, MessageId message) const {
    return from_seconds(link.draw(Purpose::routing_jitter, at, message, 0) * seconds(dsr_.jitter));
}

}  // namespace rovernet
