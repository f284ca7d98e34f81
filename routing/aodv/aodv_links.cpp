// SPDX-License-Identifier: MIT
#include "routing/aodv/aodv_router.hpp"

#include <algorithm>
#include <cstddef>

// Links that break under AODV: reports of lost destinations, local repair, HELLOs. Sections are
// those of RFC 3561.

namespace rovernet {
namespace {

constexpr int allowed_hello_loss = 2;

}  // namespace

/// Whether a node repairs the route of a packet that it could not forward (6.12).
bool AodvRouter::repairs(const Route& route, const QueuedFrame& queued) const {
    const int farthest = 3 * rules_.net_diameter / 10;  // MAX_REPAIR_TTL
    if (!rules_.local_repair || !queued.heard_from) return false;
    const int hops_so_far = queued.frame.hops - 1;
    return rules_.repairs_near_destination ? hops_so_far > route.hops : route.hops <= farthest;
}

/// Whether the node searches a new way for a route that broke.
bool AodvRouter::is_repaired(NodeId at, NodeId destination) {
    const auto& running = node(at).searches;
    return std::any_of(running.begin(), running.end(), [&](const Search& each) {
        return each.destination == destination && each.repaired_hops > 0;
    });
}

/// Repairs of the routes over a neighbour that packets were on, in the order of the packets (6.12).
std::vector<AodvRouter::Search> AodvRouter::repairs_of(LinkLayer& link, NodeId at, NodeId neighbour,
                                                       std::span<const QueuedFrame> stranded) {
    std::vector<Search> found;
    for (const QueuedFrame& each : stranded) {
        const Message& message = link.message(each.frame.message);
        if (!message.kind.empty()) continue;
        const Route* broken = valid_route(at, message.to, link.now());
        if (!broken || broken->next_hop != neighbour || !repairs(*broken, each)) continue;
        auto repair = std::find_if(found.begin(), found.end(), [&](const Search& search) {
            return search.destination == message.to;
        });
        if (repair == found.end()) {
            repair = found.insert(
                found.end(), {.destination = message.to, .ttl = 0, .repaired_hops = broken->hops});
        }
        // max(hops of the old route, half the hops to the source) + LOCAL_ADD_TTL.
        const int ttl = std::max<int>(broken->hops, (each.frame.hops - 1) / 2) + 2;
        repair->ttl = std::min(std::max(repair->ttl, ttl), rules_.net_diameter);
    }
    return found;
}

/// Breaks the routes over a neighbour that cannot be reached, and ends the packets that were on
/// their way to it (6.11 (i)).
void AodvRouter::on_broken(LinkLayer& link, NodeId at, NodeId neighbour,
                           std::span<const QueuedFrame> stranded) {
    Node& here = node(at);
    const Time now = link.now();
    const std::vector<Search> repairs = repairs_of(link, at, neighbour, stranded);
    here.searches.insert(here.searches.end(), repairs.begin(), repairs.end());
    std::vector<aodv::Error::Lost> lost;
    here.routes.for_each(now, rules_.delete_period, [&](Route& each) {
        if (!each.is_valid || each.next_hop != neighbour) return;
        each.is_valid = false;
        each.number += each.has_number ? 1 : 0;
        each.until = now + rules_.delete_period;
        lost.push_back({each.destination, each.has_number ? each.number : 0});
    });
    for (const QueuedFrame& each : stranded) {
        const Message& message = link.message(each.frame.message);
        if (!message.kind.empty()) continue;
        if (is_repaired(at, message.to)) {
            keep(link, at, message.to, each, now);
        } else {
            link.drop(at, each.as_received(), DropReason::broken);
        }
    }
    // 6.12: other routes over the neighbour are reported when a packet needs them.
    if (repairs.empty()) send_errors(link, at, lost, now, {.is_first = true});
    for (const Search& repair : repairs) {
        const auto begun =
            std::find_if(here.searches.begin(), here.searches.end(),
                         [&](const auto& s) { return s.destination == repair.destination; });
        request(link, at, *begun, now);
    }
    set_timer(link, at);
}

/// Reports lost destinations to the neighbours that used the routes, and to the one whose packet
/// could not be forwarded (6.11).
void AodvRouter::send_errors(LinkLayer& link, NodeId at, std::span<const aodv::Error::Lost> lost,
                             Time when, ErrorOptions options) {
    Node& here = node(at);
    std::vector<aodv::Error::Lost> reported;
    std::vector<NodeId> users;
    if (options.asker) users.push_back(*options.asker);
    const bool needs_no_users = options.asker || (options.is_first && rules_.errors_for_all);
    for (const aodv::Error::Lost& each : lost) {
        const std::vector<NodeId> own = here.routes.precursors(each.destination);
        if (own.empty() && !needs_no_users) continue;
        reported.push_back(each);
        for (const NodeId user : own) {
            if (std::find(users.begin(), users.end(), user) == users.end()) users.push_back(user);
        }
    }
    // Keys and not ids decide which destinations share a packet.
    std::sort(reported.begin(), reported.end(), [&](const auto& a, const auto& b) {
        return link.key(a.destination) < link.key(b.destination);
    });
    const NodeId to = users.size() == 1 && !rules_.errors_for_all ? users.front() : everyone;
    constexpr std::size_t most = 255;  // DestCount has one byte
    for (std::size_t from = 0; from < reported.size(); from += most) {
        if (here.errors.take(when) > when) return;
        const std::size_t count = std::min(most, reported.size() - from);
        aodv::Error error{.is_repaired = options.is_repaired, .lost = {}};
        error.lost.assign(reported.begin() + static_cast<std::ptrdiff_t>(from),
                          reported.begin() + static_cast<std::ptrdiff_t>(from + count));
        send_error(link, at, error, to, when);
    }
}

void AodvRouter::send_error(LinkLayer& link, NodeId at, const aodv::Error& error, NodeId to,
                            Time when) {
    const auto bytes = static_cast<std::uint32_t>(rules_.error_bytes + 8 * error.lost.size());
    const MessageId id = link.originate(at, to, aodv::error_kind, bytes, to_bytes(error));
    link.send(
        {.message = id, .sender = at, .path = link.key(at), .ttl = 1, .hops = 1, .next_hop = to},
        {}, when);
    link.release(id);
    if (error.is_repaired) return;  // its routes remain
    for (const auto& each : error.lost) node(at).routes.clear_precursors(each.destination);
}

void AodvRouter::receive_error(LinkLayer& link, const Frame& frame, const aodv::Error& error,
                               const Reception& r) {
    const NodeId at = r.node;
    std::vector<aodv::Error::Lost> passed_on;
    for (const auto& [destination, number] : error.lost) {
        Route* known = valid_route(at, destination, r.time);
        if (!known || known->next_hop != frame.sender) continue;
        if (error.is_repaired) {
            passed_on.push_back({destination, number});
            continue;
        }
        if (rules_.numbers_may_fall) {
            known->number = number;
        } else if (known->has_number) {
            const bool is_known = number != 0;
            // 6.1: stale information is discarded, also in a RERR.
            if (is_known && is_newer(known->number, number)) continue;
            // 6.11 (iii) and A14. A report with our own number may be late, of the route before.
            const std::uint32_t next = known->number + 1;
            known->number = is_known ? newest(number, next) : next;
        }
        known->is_valid = false;
        known->until = r.time + rules_.delete_period;
        passed_on.push_back({destination, known->has_number ? known->number : 0});
    }
    const Duration late = rules_.delays_errors ? jitter(link, at, frame.message) : Duration{0};
    send_errors(link, at, passed_on, r.time + least_reaction + late,
                {.is_repaired = error.is_repaired});
}

/// Notes that a neighbour was heard. Its silence ends routes over it only after a HELLO, as nodes
/// that carry no messages send none (6.9).
void AodvRouter::hear(NodeId at, NodeId neighbour, Time now, bool is_hello) {
    if (rules_.hello == Duration{0}) return;
    auto& all = node(at).neighbours;
    const auto known = std::find_if(all.begin(), all.end(),
                                    [&](const Neighbour& each) { return each.node == neighbour; });
    if (known != all.end()) {
        known->last = now;
    } else if (is_hello) {
        all.push_back({neighbour, now});
    }
}

/// Whether a neighbour is on the blacklist: it does not hear this node (6.8).
bool AodvRouter::is_blacklisted(Node& here, NodeId neighbour, Time now) const {
    std::vector<Neighbour>& all = here.one_way;
    if (all.empty()) return false;
    std::erase_if(
        all, [&](const Neighbour& each) { return now - each.last >= rules_.blacklist_timeout; });
    return std::any_of(all.begin(), all.end(),
                       [&](const Neighbour& each) { return each.node == neighbour; });
}

/// Drops a packet to a destination without a route, and sends a RERR to its sender (6.11 (ii)).
void AodvRouter::refuse(LinkLayer& link, const Frame& frame, NodeId to, const Reception& r) {
    const NodeId at = r.node;
    // The sender has a route over this node, so that the number must not be forgotten.
    Route* broken = route(at, to, r.time);
    if (broken) {
        broken->number += broken->has_number ? 1 : 0;
        broken->until = r.time + rules_.delete_period;
    }
    if (r.time < node(at).silent_until) node(at).silent_until = r.time + rules_.silence;  // 6.13
    const aodv::Error::Lost lost{to, broken && broken->has_number ? broken->number : 0};
    send_errors(link, at, {&lost, 1}, r.time + least_reaction,
                {.asker = frame.sender, .is_first = true});
    link.drop(at, frame, DropReason::no_route);
}

/// Sends a HELLO if routes carry messages and nothing was broadcast meanwhile (6.9).
void AodvRouter::send_hello(LinkLayer& link, NodeId at) {
    Node& here = node(at);
    const Time now = link.now();
    const bool has_broadcast = here.last_broadcast && now - *here.last_broadcast < rules_.hello;
    if (now >= here.active_until || has_broadcast || is_silent(at, now)) return;
    const aodv::Reply hello{.destination = at,
                            .number = here.number,
                            .originator = at,
                            .lifetime = allowed_hello_loss * rules_.hello};
    const MessageId id =
        link.originate(at, everyone, aodv::hello_kind, rules_.reply_bytes, to_bytes(hello));
    link.send({.message = id, .sender = at, .path = link.key(at), .ttl = 1, .hops = 1}, {}, now);
    link.release(id);
}

/// Ends the routes over neighbours that have been silent for too long (6.10), and sets a timer for
/// the next neighbour that may be.
void AodvRouter::end_silent(LinkLayer& link, NodeId at) {
    const Duration longest = allowed_hello_loss * rules_.hello;
    Node& here = node(at);
    const Time now = link.now();
    Time next = never;
    std::vector<NodeId> silent;
    std::erase_if(here.neighbours, [&](const Neighbour& each) {
        const Time silent_from = each.last + longest + Duration{1};
        const bool is_silent = silent_from <= now;
        if (is_silent) silent.push_back(each.node);
        if (!is_silent) next = std::min(next, silent_from);
        return is_silent;
    });
    for (const NodeId each : silent) {
        const std::vector<QueuedFrame> stranded = link.take_queued(at, each);
        on_broken(link, at, each, stranded);
        for (const QueuedFrame& queued : stranded) link.release(queued.frame);
    }
    const bool is_soon = next < now + rules_.hello;  // later ones are found by the next timer
    if (is_soon && next != node(at).silence_timer) {
        node(at).silence_timer = next;
        link.timer(at, next, Tag::silence);
    }
}

}  // namespace rovernet
