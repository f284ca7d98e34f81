// SPDX-License-Identifier: MIT
#pragma once

#include "routing/aodv.hpp"
#include "sim/message.hpp"
#include "sim/time.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace rovernet {

/// Constants of AODV as they follow from an Aodv (RFC 3561, section 10), with the differences of
/// ns-2.35, each by its place in docs/routing.md.
struct AodvRules {
    /// @throws std::invalid_argument if a parameter is out of its range
    static AodvRules of(const Aodv& aodv);

    Duration active_route_timeout, my_route_timeout, node_traversal_time, hello, jitter;
    /// Time for which a broken route keeps its sequence number: longer than any node may still use
    /// a route over the node at which it broke.
    Duration delete_period;
    /// Time for which a node that was switched on again takes no part in searches.
    Duration silence;
    /// Time for which requests of a neighbour are ignored that a reply did not reach
    /// (BLACKLIST_TIMEOUT); 0: they are not.
    Duration blacklist_timeout;
    int net_diameter, ttl, rreq_retries;
    bool rings, destination_only, gratuitous, local_repair;
    std::size_t buffer;

    // Differences of ns-2.
    /// Bytes of IP and UDP headers before data, and of all but the addresses of control packets.
    std::uint32_t data_header, request_bytes, reply_bytes, error_bytes;
    /// Whether a destination that was never known is searched by rings, too.
    bool rings_first;
    /// Largest TTL to which rings grow.
    int ring_threshold;
    /// Whether waits follow the measured time of the last searches, and searches are looked at
    /// every `poll` only, or as a packet comes.
    bool measures_latency;
    Duration poll;
    /// Time without searches after the last one; 0: the next packet begins a new one.
    Duration pause_after_failure;
    /// Whether there is a route to each neighbour that was heard, and a packet lengthens the lives
    /// of all routes that it uses, and not of the destination's alone.
    bool meets_neighbours;
    /// Whether a RERR lists routes that no neighbour uses, and goes to everyone.
    bool errors_for_all;
    /// Whether a RERR that is passed on waits for the jitter.
    bool delays_errors;
    /// Whether a node repairs a route if the packet has made more hops than are left.
    bool repairs_near_destination;
    /// Time between packets that waited for the same route.
    Duration spacing;

    // For tests of loop freedom.
    /// Sequence number with which a node begins.
    std::uint32_t first_number = 0;
    /// Whether a RERR may lower the number of a route, against rule A14.
    bool numbers_may_fall = false;

    Duration net_traversal_time() const { return 2 * node_traversal_time * net_diameter; }
    Duration path_discovery_time() const { return 2 * net_traversal_time(); }
};

}  // namespace rovernet
