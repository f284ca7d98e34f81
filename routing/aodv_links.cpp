// SPDX-License-Identifier: MIT
#include "routing/aodv_router.hpp"

#include <algorithm>
#include <cstddef>

// Links that break under AODV: reports of lost destinations, local repair, HELLOs. Sections are
// those of RFC 3561.

namespace rovernet {

/// Whether a node repairs the route of a packet that it could not forward (6.12).
bool AodvRouter::repairs(const Route& route, const QueuedFrame& queued) const {
    constexpr Hops farthest = 10;  // MAX_REPAIR_TTL is 0.3 of the net diameter
    if (!rules_.local_repair || !queued.heard_from) return false;
    const int hops_so_far = queued.frame.hops - 1;
    return rules_.repairs_near_destination ? hops_so_far > route.hops : route.hops <= farthest;
}

/// Breaks the routes over a neighbour that cannot be reached, and ends the packets that were on
/// their way to it (6.11 (i)).
void AodvRouter::on_broken(LinkLayer& link, NodeId at, NodeId neighbour,
                           std::span<const QueuedFrame> stranded) {
    const Time now = link.now();
    std::vector<aodv::Error::Lost> lost;
    std::vector<Search> repairs_to_do;
    const auto is_repaired = [&](const Route& broken) {
        return std::any_of(stranded.begin(), stranded.end(), [&](const QueuedFrame& each) {
            const Message& message = link.message(each.frame.message);
            return message.kind.empty() && message.to == broken.destination &&
                   repairs(broken, each);
        });
    };
    node(at).routes.for_each(now, rules_.delete_period, [&](Route& each) {
        if (!each.is_valid || each.next_hop != neighbour) return;
        const bool repaired = is_repaired(each);
        each.is_valid = false;
        each.number += each.has_number ? 1 : 0;
        each.until = now + rules_.delete_period;
        if (repaired) {
            repairs_to_do.push_back({.destination = each.destination, .repaired_hops = each.hops});
        } else {
            lost.push_back({each.destination, each.has_number ? each.number : 0});
        }
    });
    const auto& running = node(at).searches;
    for (Search& each : repairs_to_do) {
        // 6.12: max(hops of the old route, half the hops to the source) + LOCAL_ADD_TTL.
        Hops to_source = 0;
        for (const QueuedFrame& q : stranded) {
            if (link.message(q.frame.message).to == each.destination)
                to_source = std::max(to_source, static_cast<Hops>(q.frame.hops - 1));
        }
        each.ttl = std::max<int>(each.repaired_hops, to_source / 2) + 2;
        node(at).searches.push_back(each);
    }
    for (const QueuedFrame& each : stranded) {
        const Message& message = link.message(each.frame.message);
        if (!message.kind.empty()) continue;
        const NodeId to = message.to;
        const bool waits = std::any_of(running.begin(), running.end(), [&](const Search& search) {
            return search.destination == to && search.repaired_hops > 0;
        });
        if (waits) {
            keep(link, at, to, each);
        } else {
            link.drop(at, each.as_received(), DropReason::broken);
        }
    }
    // 6.12: other routes over the neighbour are reported when a packet needs them.
    if (repairs_to_do.empty()) send_errors(link, at, lost, now, {.is_first = true});
    for (const Search& each : repairs_to_do) {
        for (Search& search : node(at).searches) {
            if (search.destination == each.destination) request(link, at, search, now);
        }
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
        if (!options.is_repaired) here.routes.clear_precursors(each.destination);
    }
    constexpr std::size_t most = 255;  // DestCount has one byte
    for (std::size_t from = 0; from < reported.size(); from += most) {
        if (here.errors.take(when) > when) return;
        const std::size_t count = std::min(most, reported.size() - from);
        aodv::Error error{.is_repaired = options.is_repaired, .lost = {}};
        error.lost.assign(reported.begin() + static_cast<std::ptrdiff_t>(from),
                          reported.begin() + static_cast<std::ptrdiff_t>(from + count));
        const auto bytes = static_cast<std::uint32_t>(rules_.error_bytes + 8 * count);
        const MessageId id = link.originate(at, everyone, aodv::error_kind, bytes, to_bytes(error));
        const bool is_for_one = users.size() == 1 && !rules_.errors_for_all;
        link.send({.message = id,
                   .sender = at,
                   .path = link.key(at),
                   .ttl = 1,
                   .hops = 1,
                   .next_hop = is_for_one ? users.front() : everyone},
                  {}, when);
        link.release(id);
    }
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

/// Sends a HELLO if routes are in use and nothing was broadcast meanwhile, and looks for neighbours
/// that have fallen silent (6.9, 6.10).
void AodvRouter::send_hello(LinkLayer& link, NodeId at) {
    constexpr int allowed_hello_loss = 2;
    Node& here = node(at);
    const Time now = link.now();
    if (!link.is_on(at)) return;
    bool is_in_use = false;
    here.routes.for_each(now, rules_.delete_period,
                         [&](const Route& each) { is_in_use = is_in_use || each.is_valid; });
    if (is_in_use && now - here.last_broadcast >= rules_.hello && !is_silent(at, now)) {
        const aodv::Reply hello{.destination = at,
                                .number = here.number,
                                .originator = at,
                                .lifetime = allowed_hello_loss * rules_.hello};
        const MessageId id =
            link.originate(at, everyone, aodv::hello_kind, rules_.reply_bytes, to_bytes(hello));
        link.send({.message = id, .sender = at, .path = link.key(at), .ttl = 1, .hops = 1}, {},
                  now);
        link.release(id);
        here.last_broadcast = now;
    }
    std::vector<NodeId> silent;
    std::erase_if(here.neighbours, [&](const Neighbour& each) {
        if (now - each.last <= allowed_hello_loss * rules_.hello) return false;
        silent.push_back(each.node);
        return true;
    });
    for (const NodeId each : silent) {
        const std::vector<QueuedFrame> stranded = link.take_queued(at, each);
        on_broken(link, at, each, stranded);
        for (const QueuedFrame& queued : stranded) link.release(queued.frame);
    }
}

}  // namespace rovernet
