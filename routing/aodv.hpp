// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "sim/router.hpp"

#include <array>
#include <chrono>
#include <optional>
#include <string_view>

namespace rovernet {

/// Variant of AODV: the text of RFC 3561, or the implementation in ns-2.35
/// (docs/methods/routing.md).
enum class AodvProfile { rfc, ns2 };

/// Names of the values of `profile` in scenario files.
template <>
struct EnumNames<AodvProfile> {
    static constexpr std::array<std::string_view, 2> values = {"rfc", "ns2"};
};

/// Ad hoc on-demand distance vector routing of messages to one robot (RFC 3561). A node without a
/// route floods a request (RREQ). The destination, or a node with a route that is new enough, sends
/// a reply along the reverse route (RREP). A node whose next hop cannot be reached reports the lost
/// destinations to the neighbours that used routes over this next hop (RERR). Sequence numbers of
/// destinations keep routes free of loops.
///
/// Messages to everyone go over one hop. A robot that was switched off starts again without routes,
/// and takes no part in route searches for DELETE_PERIOD (6.13).
struct Aodv {
    static constexpr std::string_view name = "aodv";

    /// Variant of AODV; determines the default of each parameter that is not given.
    AodvProfile profile = AodvProfile::rfc;
    /// Lifetime of an unused route [ns]; default: 3 s, with profile ns2 10 s.
    std::optional<Duration> active_route_timeout = std::nullopt;
    /// Lifetime of a route in a reply of its destination [ns]; default: twice active_route_timeout,
    /// with profile ns2 10 s.
    std::optional<Duration> my_route_timeout = std::nullopt;
    /// Longest time of a packet for one hop [ns]; default: 40 ms, with profile ns2 30 ms.
    std::optional<Duration> node_traversal_time = std::nullopt;
    /// TTL of a request to the whole network [hops]; default: 35, with profile ns2 30.
    std::optional<int> net_diameter = std::nullopt;
    /// Number of repeated requests to the whole network if the first one is not answered; default:
    /// 2, with profile ns2 3.
    std::optional<int> rreq_retries = std::nullopt;
    /// Whether a route search begins with small TTLs (expanding ring search, 6.4); with profile ns2
    /// only if the destination was known before.
    bool rings = true;
    /// Whether only the destination may answer a request, not a node with a route (flag D).
    bool destination_only = false;
    /// Whether a node that answers a request in place of the destination also sends the destination
    /// the route to the originator, for traffic in both directions (gratuitous reply, flag G,
    /// 6.6.3).
    bool gratuitous = false;
    /// Period of the HELLO packets of a node whose routes carry messages [ns]; 0: no HELLO packets,
    /// because the link layer reports broken links.
    Duration hello{0};
    /// Whether a node near the destination searches a new route for packets whose next hop cannot
    /// be reached (6.12); default: false, with profile ns2 true.
    std::optional<bool> local_repair = std::nullopt;
    /// Largest number of packets that wait at a node for routes, each for at most 30 s.
    int buffer = 64;
    /// Initial TTL of messages [hops]; default: 64, with profile ns2 30.
    std::optional<int> ttl = std::nullopt;
    /// Longest random delay before a request is forwarded [ns].
    Duration jitter = std::chrono::milliseconds{10};

    static constexpr auto fields() {
        constexpr Range seconds_range{.low = 0, .high = 1e4, .text = "from 0 to 10000 s"};
        constexpr Range hops_range{.low = 1, .high = 255, .text = "from 1 to 255"};
        return describe(
            field("profile", &Aodv::profile,
                  "variant of the protocol. rfc: as in the text of RFC 3561; ns2: as in ns-2.35, "
                  "with its defaults"),
            field("active_route_timeout", &Aodv::active_route_timeout, seconds_range,
                  "time after which a route ends if no message uses it; if not given, 3 s (10 s "
                  "with profile ns2)"),
            field("my_route_timeout", &Aodv::my_route_timeout, seconds_range,
                  "lifetime of a route if the destination itself answers the request; if not "
                  "given, 2 * active_route_timeout (10 s with profile ns2)"),
            field("node_traversal_time", &Aodv::node_traversal_time, seconds_range,
                  "longest time that a packet is assumed to need for one hop; if not given, 40 ms "
                  "(30 ms with profile ns2)"),
            field("net_diameter", &Aodv::net_diameter, hops_range,
                  "TTL of a search of the whole network; if not given, 35 (30 with profile ns2)"),
            field("rreq_retries", &Aodv::rreq_retries,
                  Range{.low = 0, .high = 100, .text = "from 0 to 100"},
                  "number of times that a search of the whole network is repeated if it gets no "
                  "answer; if not given, 2 (3 with profile ns2)"),
            field("rings", &Aodv::rings,
                  "true: a search begins with requests with small TTLs; false: every search begins "
                  "with the whole network"),
            field("destination_only", &Aodv::destination_only,
                  "true: only the destination answers requests; false: a robot with a route to the "
                  "destination also answers"),
            field("gratuitous", &Aodv::gratuitous,
                  "true: a robot that answers a request in place of the destination also sends the "
                  "destination a route to the originator of the request"),
            field("hello", &Aodv::hello, seconds_range,
                  "time between the HELLO packets of a robot; 0 s: no HELLO packets (csma reports "
                  "broken links without them)"),
            field("local_repair", &Aodv::local_repair,
                  "true: a robot that cannot forward a message may search for a new route itself; "
                  "if not given, false (true with profile ns2)"),
            field("buffer", &Aodv::buffer, Range{.low = 1, .high = 1e6, .text = "from 1 to 1e6"},
                  "largest number of messages that wait for routes at a robot"),
            field(
                "ttl", &Aodv::ttl, Range{.low = 1, .high = 65535, .text = "from 1 to 65535"},
                "number of hops that a message may cross; if not given, 64 (30 with profile ns2)"),
            field("jitter", &Aodv::jitter, Range{.low = 0, .high = 1e9, .text = "from 0 to 1e9 s"},
                  "upper limit of the uniform random delay before a robot forwards a request"));
    }

    operator Router() const;
};

}  // namespace rovernet
