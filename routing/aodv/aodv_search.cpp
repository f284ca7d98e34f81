// SPDX-License-Identifier: MIT
#include "routing/aodv/aodv_router.hpp"

#include <algorithm>
#include <numeric>

// Searches of AODV: requests, replies, waits. Sections are those of RFC 3561.

namespace rovernet {

/// Starts a search for a destination to which a packet waits, or goes on with one whose wait is
/// over.
void AodvRouter::search(LinkLayer& link, NodeId at, NodeId destination, Time when) {
    auto& all = node(at).searches;
    const auto running = std::find_if(all.begin(), all.end(), [&](const Search& each) {
        return each.destination == destination;
    });
    if (running == all.end()) {
        const int ttl = first_ttl(route(at, destination, when));
        request(link, at, all.emplace_back(Search{.destination = destination, .ttl = ttl}), when);
    } else if (rules_.poll > Duration{0} && running->until <= when) {
        proceed(link, at, *running, when);
    }
    set_timer(link, at);
}

/// Goes on with a search whose wait is over: asks again, farther, or gives up.
void AodvRouter::proceed(LinkLayer& link, NodeId at, Search& search, Time when) {
    const bool is_wanted = node(at).buffer.has(search.destination);
    if (is_wanted && (search.pauses || widen(search))) {
        search.pauses = false;
        request(link, at, search, when);
    } else {
        give_up(link, at, search);
    }
}

/// TTL of the first request for a destination (6.4).
int AodvRouter::first_ttl(const Route* known) const {
    constexpr int start = 1, increment = 2;
    if (!rules_.rings) return rules_.net_diameter;
    if (!known || known->hops == 0) return rules_.rings_first ? start : rules_.net_diameter;
    const int ttl = known->hops + increment;
    return ttl > rules_.ring_threshold ? rules_.net_diameter : std::min(ttl, rules_.net_diameter);
}

/// Chooses the next TTL of a search (6.4). @return whether there is one
bool AodvRouter::widen(Search& search) const {
    if (search.repaired_hops > 0) return false;
    if (search.ttl >= rules_.net_diameter) return search.full <= rules_.rreq_retries;
    search.ttl += 2;
    if (search.ttl > rules_.ring_threshold) search.ttl = rules_.net_diameter;
    search.ttl = std::min(search.ttl, rules_.net_diameter);
    return true;
}

/// Time to wait for the answer to a request (6.3, 6.4).
Duration AodvRouter::wait(NodeId at, const Search& search) {
    if (rules_.measures_latency) {
        constexpr double longest = 10;
        double per_hop = seconds(rules_.node_traversal_time);
        for (const Latency& each : node(at).latencies) {
            if (each.destination != search.destination) continue;
            const auto known = std::count_if(each.times.begin(), each.times.end(),
                                             [](float time) { return time > 0; });
            if (known == 0) continue;
            per_hop = std::accumulate(each.times.begin(), each.times.end(), 0.0) /
                      static_cast<double>(known);
        }
        return from_seconds(std::min(longest, 2 * search.ttl * per_hop * std::max(search.full, 1)));
    }
    constexpr int timeout_buffer = 2;
    if (search.ttl < rules_.net_diameter || search.repaired_hops > 0) {
        return 2 * rules_.node_traversal_time * (search.ttl + timeout_buffer);
    }
    constexpr Duration longest = std::chrono::hours{24};  // of a search that nobody waits for
    Duration doubled = rules_.net_traversal_time();
    for (int i = 1; i < search.full && doubled < longest; ++i) doubled *= 2;
    return doubled;
}

/// Time at which a search goes on by itself.
Time AodvRouter::due(const Search& search) const {
    if (rules_.poll == Duration{0}) return search.until;
    const auto since = search.until - start_of_run;
    return start_of_run + (since + rules_.poll - Duration{1}) / rules_.poll * rules_.poll;
}

/// Sends the request of a search (6.3).
void AodvRouter::request(LinkLayer& link, NodeId at, Search& search, Time when) {
    Node& here = node(at);
    const Time allowed = is_silent(at, when) ? here.silent_until : here.requests.take(when);
    if (allowed > when) {
        search.pauses = true;
        search.until = allowed;
        return;
    }
    ++here.number;
    if (search.ttl >= rules_.net_diameter) ++search.full;
    const Route* known = route(at, search.destination, when);
    aodv::Request request{.gratuitous = rules_.gratuitous,
                          .destination_only = rules_.destination_only,
                          .id = ++here.request,
                          .destination = search.destination,
                          .number = std::nullopt,
                          .originator = at,
                          .originator_number = here.number};
    if (known && known->has_number) request.number = known->number;
    const MessageId id =
        link.originate(at, everyone, aodv::request_kind, rules_.request_bytes, to_bytes(request));
    link.send({.message = id,
               .sender = at,
               .path = link.key(at),
               .ttl = static_cast<Hops>(search.ttl),
               .hops = 1},
              {}, when);
    link.release(id);
    here.last_broadcast = when;
    search.begun = when;
    search.until = when + wait(at, search);
}

/// Ends a search without an answer, and the packets that waited for it.
void AodvRouter::give_up(LinkLayer& link, NodeId at, Search& search) {
    const NodeId destination = search.destination;
    const bool was_repair = search.repaired_hops > 0;
    SendBuffer& buffer = node(at).buffer;
    const std::vector<SendBuffer::Packet> waited = buffer.take(destination);
    for (const auto& packet : waited) {
        // Own packets wait for a search of their own.
        const bool stays = was_repair && !packet.queued.heard_from;
        stays ? void(buffer.add(packet, rules_.buffer))
              : lose(link, at, packet, DropReason::no_route);
    }
    search.pauses = !waited.empty() && !was_repair && rules_.pause_after_failure > Duration{0};
    search.until = link.now() + rules_.pause_after_failure;
    search.full = 0;
    if (!search.pauses) search.ttl = 0;  // the search is over
    if (!was_repair) return;
    const Route* broken = route(at, destination, link.now());
    const aodv::Error::Lost lost{destination, broken && broken->has_number ? broken->number : 0};
    send_errors(link, at, {&lost, 1}, link.now(), {.is_first = true});  // 6.12
    if (!buffer.has(destination)) return;
    search = {.destination = destination, .ttl = first_ttl(broken)};
    request(link, at, search, link.now());
}

/// Ends the search for a destination to which there is a route, and sends what waited for it.
void AodvRouter::end_search(LinkLayer& link, NodeId at, NodeId destination, Time when) {
    Node& here = node(at);
    const auto ended = std::find_if(here.searches.begin(), here.searches.end(),
                                    [&](const auto& s) { return s.destination == destination; });
    if (ended == here.searches.end()) return;
    const Route* found = valid_route(at, destination, when);
    if (!found) return;
    const Route known = *found;  // the entry may move
    const Hops before = ended->repaired_hops;
    here.searches.erase(ended);
    Time then = when;
    for (const auto& packet : here.buffer.take(destination)) {
        send_on(link, packet.queued, known.next_hop, then);
        then += std::max(rules_.spacing, link.spacing(packet.queued.frame));
        link.release(packet.queued.frame);
    }
    use(at, destination, known.next_hop, when);
    if (before > 0 && known.hops > before) {  // 6.12: the repaired route is longer
        const aodv::Error::Lost longer{destination, known.number};
        send_errors(link, at, {&longer, 1}, when, {.is_first = true, .is_repaired = true});
    }
}

void AodvRouter::note_latency(NodeId at, const Search& search, Hops hops, Time now) {
    if (!search.begun) return;  // the reply is to an earlier search
    auto& all = node(at).latencies;
    auto found = std::find_if(all.begin(), all.end(), [&](const Latency& each) {
        return each.destination == search.destination;
    });
    if (found == all.end()) found = all.insert(all.end(), {.destination = search.destination});
    found->times[found->next] = static_cast<float>(seconds(now - *search.begun) / hops);
    found->next = static_cast<std::uint8_t>((found->next + 1) % found->times.size());
}

/// Removes searches that are over, and sets the timer for the first one that goes on, or the first
/// packet that has waited too long.
void AodvRouter::set_timer(LinkLayer& link, NodeId at) {
    Node& here = node(at);
    std::erase_if(here.searches, [](const Search& each) { return each.ttl == 0; });
    std::optional<Time> next = here.buffer.first_end();
    for (const Search& each : here.searches) next = std::min(next.value_or(due(each)), due(each));
    if (!next || (here.timer && *here.timer <= *next)) return;
    here.timer = std::max(*next, link.now() + least_reaction);
    link.timer(at, *here.timer, Tag::searches);
}

/// Notes that a neighbour was heard: there is a route to it, whatever its number (6.5, 6.7).
void AodvRouter::meet(NodeId at, NodeId neighbour, Time now) {
    if (!rules_.meets_neighbours) return;
    Node& here = node(at);
    Route& direct = here.routes.add(neighbour, now, rules_.delete_period);
    const Time until = now + rules_.active_route_timeout;
    if (!direct.is_valid || direct.next_hop != neighbour) direct.since = now;
    direct.until = direct.is_valid ? std::max(direct.until, until) : until;
    direct.next_hop = neighbour;
    direct.hops = 1;
    direct.is_valid = true;
}

/// Takes an offered route if it is newer, or equally new and better (6.2). The lifetime of a valid
/// route is not shortened by one that is as new. @return whether it was taken
bool AodvRouter::learn(NodeId at, const Route& offered, Time now) {
    if (offered.destination == at) return false;  // A15
    Route& known = node(at).routes.add(offered.destination, now, rules_.delete_period);
    const bool is_better =
        !known.has_number || is_newer(offered.number, known.number) ||
        (offered.number == known.number && (!known.is_valid || offered.hops < known.hops));
    if (is_better) {
        const Time until = known.is_valid ? std::max(known.until, offered.until) : offered.until;
        known = offered;
        known.until = until;
        known.since = now;
    } else if (known.is_valid && known.next_hop == offered.next_hop) {
        known.until = std::max(known.until, offered.until);
    }
    return is_better;
}

Fate AodvRouter::receive_request(LinkLayer& link, const Frame& frame, const aodv::Request& request,
                                 const Reception& r) {
    const NodeId at = r.node, from = frame.sender;
    const Time when = r.time + least_reaction;
    if (is_silent(at, r.time)) return Fate::arrived;  // 6.13
    Node& here = node(at);
    if (is_blacklisted(here, from, r.time)) return Fate::arrived;  // 6.8: it hears no reply
    meet(at, from, r.time);
    end_search(link, at, from, when);
    if (request.originator == at ||
        !here.seen.note(request.originator, request.id, r.time, rules_.path_discovery_time())) {
        return Fate::duplicate;
    }
    // 6.5: the reverse route.
    const Duration lifetime =
        2 * rules_.net_traversal_time() - 2 * frame.hops * rules_.node_traversal_time;
    learn(at,
          {.destination = request.originator,
           .next_hop = from,
           .number = request.originator_number,
           .hops = frame.hops,
           .has_number = true,
           .is_valid = true,
           .until = r.time + std::max(lifetime, rules_.node_traversal_time)},
          r.time);
    // 6.1: a request that is older than what is known of its originator is discarded; whoever got
    // it from here would have a route over this node, which has none.
    if (!valid_route(at, request.originator, r.time)) return Fate::arrived;
    end_search(link, at, request.originator, when);
    if (answer(link, from, request, r)) return Fate::arrived;
    if (frame.ttl <= 1) return Fate::ttl;
    forward_request(link, frame, request, r);
    return Fate::waiting;
}

/// Answers a request as its destination, or with a route to it (6.6). @return whether it did
bool AodvRouter::answer(LinkLayer& link, NodeId from, const aodv::Request& request,
                        const Reception& r) {
    const NodeId at = r.node;
    const Time when = r.time + least_reaction;
    Node& here = node(at);
    if (request.destination == at) {
        here.number = newest(here.number, request.number.value_or(here.number));  // 6.1, 6.6.1
        // Nodes whose valid route is as new do not forward a reply (6.7); flag D silenced them.
        if (request.destination_only) ++here.number;
        reply(link, at,
              {.destination = at,
               .number = here.number,
               .originator = request.originator,
               .lifetime = rules_.my_route_timeout},
              when);
        return true;
    }
    const Route* known = valid_route(at, request.destination, r.time);
    const bool is_new_enough = known && known->has_number && !request.destination_only &&
                               (!request.number || !is_newer(*request.number, known->number));
    if (!is_new_enough) return false;
    const Route there = *known;  // 6.6.2
    here.routes.add_precursor(there.destination, from);
    here.routes.add_precursor(request.originator, there.next_hop);
    reply(link, at,
          {.hops = static_cast<std::uint8_t>(std::min<int>(there.hops, 255)),
           .destination = there.destination,
           .number = there.number,
           .originator = request.originator,
           .lifetime = there.until - r.time},
          when);
    if (request.gratuitous) tell_way_back(link, r, request);
    return true;
}

/// Forwards a request, with the larger one of its number of the destination and that of the node
/// (6.5).
void AodvRouter::forward_request(LinkLayer& link, const Frame& frame, aodv::Request request,
                                 const Reception& r) {
    const NodeId at = r.node;
    const Route* known = route(at, request.destination, r.time);
    const bool knows_more =
        known && known->has_number && (!request.number || is_newer(known->number, *request.number));
    MessageId id = frame.message;
    if (knows_more) {
        request.number = known->number;
        id = link.originate(at, everyone, aodv::request_kind, rules_.request_bytes,
                            to_bytes(request));
    }
    const Time when = r.time + least_reaction + jitter(link, at, frame.message);
    link.send({.message = id,
               .sender = at,
               .path = combine(frame.path, link.key(at)),
               .ttl = static_cast<Hops>(frame.ttl - 1),
               .hops = static_cast<Hops>(frame.hops + 1)},
              frame.sender, when);
    if (knows_more) link.release(id);
    node(at).last_broadcast = when;
}

/// Sends a reply along the reverse route, if there is one (6.6).
void AodvRouter::reply(LinkLayer& link, NodeId at, const aodv::Reply& reply, Time when) {
    const Route* back = valid_route(at, reply.originator, when);
    if (!back) return;
    const MessageId id =
        link.originate(at, reply.originator, aodv::reply_kind, rules_.reply_bytes, to_bytes(reply));
    link.send({.message = id,
               .sender = at,
               .path = link.key(at),
               .ttl = static_cast<Hops>(rules_.net_diameter),
               .hops = 1,
               .next_hop = back->next_hop},
              {}, when);
    link.release(id);
}

/// Tells a destination the way to a node that has asked for it, and got an answer here (6.6.3).
void AodvRouter::tell_way_back(LinkLayer& link, const Reception& r, const aodv::Request& request) {
    const Route* back = valid_route(r.node, request.originator, r.time);
    if (!back || !back->has_number) return;
    reply(link, r.node,
          {.hops = static_cast<std::uint8_t>(std::min<int>(back->hops, 255)),
           .destination = request.originator,
           .number = back->number,
           .originator = request.destination,
           .lifetime = back->until - r.time},
          r.time + least_reaction);
}

Fate AodvRouter::receive_reply(LinkLayer& link, const Frame& frame, const aodv::Reply& reply,
                               const Reception& r) {
    const NodeId at = r.node, from = frame.sender;
    const Time when = r.time + least_reaction;
    if (is_silent(at, r.time)) return Fate::arrived;  // 6.13
    const auto hops = static_cast<Hops>(reply.hops + frame.hops);
    // Before meet(), which would revive a broken route to the destination, if that is the sender;
    // its reply would then tell nothing new (6.7 (iii)).
    const bool is_new = learn(at,
                              {.destination = reply.destination,
                               .next_hop = from,
                               .number = reply.number,
                               .hops = hops,
                               .has_number = true,
                               .is_valid = true,
                               .until = r.time + reply.lifetime},
                              r.time);
    if (reply.originator == at && rules_.measures_latency) {
        for (const Search& each : node(at).searches) {
            if (each.destination == reply.destination) note_latency(at, each, hops, r.time);
        }
    }
    meet(at, from, r.time);
    end_search(link, at, from, when);
    end_search(link, at, reply.destination, when);
    const bool is_hello = reply.originator == reply.destination;
    if (reply.originator == at || is_hello || !is_new) return Fate::arrived;
    // 6.7: along the reverse route, whose life it lengthens.
    const Route* back = valid_route(at, reply.originator, r.time);
    if (!back || frame.ttl <= 1) return Fate::arrived;
    const NodeId next_hop = back->next_hop;
    refresh(at, reply.originator, r.time);
    node(at).active_until = r.time + rules_.active_route_timeout;
    RouteTable& routes = node(at).routes;
    routes.add_precursor(reply.destination, next_hop);
    routes.add_precursor(from, next_hop);
    routes.add_precursor(reply.originator, from);
    routes.add_precursor(next_hop, from);
    link.send({.message = frame.message,
               .sender = at,
               .path = combine(frame.path, link.key(at)),
               .ttl = static_cast<Hops>(frame.ttl - 1),
               .hops = static_cast<Hops>(frame.hops + 1),
               .next_hop = next_hop},
              from, when);
    return Fate::waiting;
}

}  // namespace rovernet
