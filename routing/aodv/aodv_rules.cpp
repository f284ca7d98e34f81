// SPDX-License-Identifier: MIT
#include "routing/aodv/aodv_rules.hpp"

#include <algorithm>

namespace rovernet {
namespace {

using namespace std::chrono_literals;

AodvRules rfc() {
    return {.active_route_timeout = 3s,
            .my_route_timeout = {},
            .node_traversal_time = 40ms,
            .hello = {},
            .jitter = {},
            .delete_period = {},
            .silence = {},
            .blacklist_timeout = {},
            .net_diameter = 35,
            .ttl = 64,
            .rreq_retries = 2,
            .rings = true,
            .destination_only = false,
            .gratuitous = false,
            .local_repair = false,
            .buffer = 64,
            .data_header = 28,
            .request_bytes = 52,
            .reply_bytes = 48,
            .error_bytes = 32,
            .rings_first = true,
            .ring_threshold = 7,
            .measures_latency = false,
            .poll = {},
            .pause_after_failure = {},
            .meets_neighbours = true,
            .errors_for_all = false,
            .delays_errors = false,
            .repairs_near_destination = false,
            .spacing = {}};
}

AodvRules ns2() {
    AodvRules r = rfc();
    r.active_route_timeout = 10s;
    r.my_route_timeout = 10s;
    r.node_traversal_time = 30ms;
    r.net_diameter = 30;
    r.ttl = 30;
    r.rreq_retries = 3;
    r.local_repair = true;
    r.data_header = 20;     // no UDP
    r.request_bytes = 48;   // no UDP, a time of 4 bytes
    r.reply_bytes = 44;     // the same
    r.error_bytes = 24;     // no UDP
    r.rings_first = false;  // "last hop count" begins with 255
    r.ring_threshold = 8;   // 6 + 2, as 6 is below TTL_THRESHOLD
    r.measures_latency = true;
    r.poll = 500ms;
    r.pause_after_failure = 10s;
    r.meets_neighbours = false;
    r.errors_for_all = true;
    r.delays_errors = true;
    r.repairs_near_destination = true;
    r.spacing = 10ms;  // ARP_DELAY
    return r;
}

}  // namespace

AodvRules AodvRules::of(const Aodv& aodv) {
    check_fields(aodv, "aodv");
    AodvRules r = aodv.profile == AodvProfile::ns2 ? ns2() : rfc();
    const auto take = [](auto& rule, const auto& given) { rule = given.value_or(rule); };
    take(r.active_route_timeout, aodv.active_route_timeout);
    if (r.my_route_timeout == Duration{0}) r.my_route_timeout = 2 * r.active_route_timeout;
    take(r.my_route_timeout, aodv.my_route_timeout);
    take(r.node_traversal_time, aodv.node_traversal_time);
    take(r.net_diameter, aodv.net_diameter);
    take(r.rreq_retries, aodv.rreq_retries);
    take(r.local_repair, aodv.local_repair);
    take(r.ttl, aodv.ttl);
    r.rings = aodv.rings;
    r.destination_only = aodv.destination_only;
    r.gratuitous = aodv.gratuitous;
    r.hello = aodv.hello;
    r.jitter = aodv.jitter;
    r.buffer = static_cast<std::size_t>(aodv.buffer);
    // A neighbour may use a route for its whole lifetime, and once more after its last message.
    const Duration longest_life = std::max(r.my_route_timeout, r.path_discovery_time());
    r.delete_period = std::max(5 * std::max(r.active_route_timeout, r.hello),
                               longest_life + r.active_route_timeout);
    r.silence = r.delete_period;
    if (aodv.profile == AodvProfile::rfc) {
        r.blacklist_timeout = r.rreq_retries * r.net_traversal_time();
    }
    return r;
}

}  // namespace rovernet
