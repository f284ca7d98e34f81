// SPDX-License-Identifier: MIT
#pragma once

#include "routing/aodv.hpp"
#include "sim/message.hpp"
#include "sim/time.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace rovernet {

/// Constants of AODV (RFC 3561, section 10), computed from the parameters in an Aodv; and the
/// differences of ns-2.35, each of which docs/methods/routing.md lists.
struct AodvRules {
    /// Constants for the parameters `aodv`.
    /// @throws std::invalid_argument if a parameter is out of its range
    static AodvRules of(const Aodv& aodv);

    Duration active_route_timeout, my_route_timeout, node_traversal_time, hello, jitter;
    /// Time for which a broken route is stored with its sequence number [ns]: longer than other
    /// nodes may keep routes over this node.
    Duration delete_period;
    /// Time for which a node that was switched on again takes no part in route searches [ns].
    Duration silence;
    /// Time for which a node ignores requests from a neighbour that a reply did not reach [ns]
    /// (BLACKLIST_TIMEOUT); 0: the node ignores no requests.
    Duration blacklist_timeout;
    int net_diameter, ttl, rreq_retries;
    bool rings, destination_only, gratuitous, local_repair;
    std::size_t buffer;

    // Differences of ns-2.
    /// Sizes [bytes]: headers (IP, UDP) before data; RREQ, RREP, and RERR without its destinations,
    /// each with these headers.
    std::uint32_t data_header, request_bytes, reply_bytes, error_bytes;
    /// Whether the search for a destination that was never known also begins with small TTLs
    /// (rings).
    bool rings_first;
    /// Largest TTL of a ring [hops]; after this ring the TTL is net_diameter.
    int ring_threshold;
    /// Whether the wait for a reply follows from the durations of the last searches; and interval
    /// [ns] of the times at which a search continues, unless a packet comes earlier (0: exactly
    /// when its wait ends).
    bool measures_latency;
    Duration poll;
    /// Time without requests after a search has failed [ns]; 0: the next packet begins a new
    /// search.
    Duration pause_after_failure;
    /// True: a node stores a route to each neighbour that it hears, and a message extends the
    /// lifetimes of all routes that it uses. False: a message extends only the lifetime of the
    /// route to its destination.
    bool meets_neighbours;
    /// Whether a RERR also lists routes that no neighbour uses, and is broadcast.
    bool errors_for_all;
    /// Whether a node forwards a RERR after the random delay `jitter`, not immediately.
    bool delays_errors;
    /// Whether a node repairs a route if the packet has made more hops than remain; if false, a
    /// node repairs a route with at most 10 remaining hops.
    bool repairs_near_destination;
    /// Time between the transmissions of packets that waited for the same route [ns].
    Duration spacing;

    // For tests of loop freedom.
    /// Initial sequence number of a node.
    std::uint32_t first_number = 0;
    /// Whether a RERR may decrease the sequence number of a route, against rule A14 (AodvRouter).
    bool numbers_may_fall = false;

    Duration net_traversal_time() const { return 2 * node_traversal_time * net_diameter; }
    Duration path_discovery_time() const { return 2 * net_traversal_time(); }
};

}  // namespace rovernet
