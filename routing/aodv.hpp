// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "sim/router.hpp"

#include <array>
#include <chrono>
#include <optional>
#include <string_view>

namespace rovernet {

/// Variant of AODV: the text of RFC 3561, or what ns-2.35 makes of it (docs/routing.md).
enum class AodvProfile { rfc, ns2 };

template <>
struct EnumNames<AodvProfile> {
    static constexpr std::array<std::string_view, 2> values = {"rfc", "ns2"};
};

/// Ad hoc on-demand distance vector routing of messages to one robot (RFC 3561). A node without a
/// route floods a request (RREQ); the destination, or a node with a route that is new enough,
/// answers along the way back (RREP); a node whose next hop is gone reports the lost destinations
/// to the neighbours that used it (RERR). Sequence numbers of destinations keep routes free of
/// loops.
///
/// Messages to everyone go over one hop. A robot that was switched off starts again without routes,
/// and stays out of searches for DELETE_PERIOD (6.13).
struct Aodv {
    static constexpr std::string_view name = "aodv";

    /// Variant; the keys below that are not given have its values.
    AodvProfile profile = AodvProfile::rfc;
    /// Time for which an unused route is kept [ns]: 3 s; ns2: 10 s.
    std::optional<Duration> active_route_timeout = std::nullopt;
    /// Lifetime of a route that its destination offers [ns]: twice active_route_timeout; ns2: 10 s.
    std::optional<Duration> my_route_timeout = std::nullopt;
    /// Longest time that a packet takes for a hop [ns]: 40 ms; ns2: 30 ms.
    std::optional<Duration> node_traversal_time = std::nullopt;
    /// TTL of a search of the whole network [hops]: 35; ns2: 30.
    std::optional<int> net_diameter = std::nullopt;
    /// Searches of the whole network after the first one that is not answered: 2; ns2: 3.
    std::optional<int> rreq_retries = std::nullopt;
    /// Whether a search begins with small TTLs (expanding ring search, 6.4); ns2: only if the
    /// destination was known before.
    bool rings = true;
    /// Whether only the destination may answer a request (flag D).
    bool destination_only = false;
    /// Whether a node that answers in place of the destination tells it the way back (flag G,
    /// 6.6.3), for traffic in both directions.
    bool gratuitous = false;
    /// Time between HELLO packets of a node whose routes carry messages [ns]; 0: none, as the link
    /// layer reports broken links.
    Duration hello{0};
    /// Whether a node near the destination searches a new way for packets whose next hop is gone
    /// (6.12); ns2: it does.
    std::optional<bool> local_repair = std::nullopt;
    /// Packets that may wait at a node for routes, for 30 s each.
    int buffer = 64;
    /// TTL of messages [hops]: 64; ns2: 30.
    std::optional<int> ttl = std::nullopt;
    /// Longest random delay before a request is forwarded [ns].
    Duration jitter = std::chrono::milliseconds{10};

    static constexpr auto fields() {
        constexpr Range seconds_range{.low = 0, .high = 1e4, .text = "from 0 to 10000 s"};
        constexpr Range hops_range{.low = 1, .high = 255, .text = "from 1 to 255"};
        return describe(
            field("profile", &Aodv::profile, "RFC 3561, or as ns-2.35 does it"),
            field("active_route_timeout", &Aodv::active_route_timeout, seconds_range,
                  "for which an unused route is kept; 3 s if not given"),
            field("my_route_timeout", &Aodv::my_route_timeout, seconds_range,
                  "lifetime of a route that its destination offers; 2 active_route_timeout"),
            field("node_traversal_time", &Aodv::node_traversal_time, seconds_range,
                  "longest time of a packet for a hop; 40 ms if not given"),
            field("net_diameter", &Aodv::net_diameter, hops_range,
                  "hops of a search of the whole network; 35 if not given"),
            field("rreq_retries", &Aodv::rreq_retries,
                  Range{.low = 0, .high = 100, .text = "from 0 to 100"},
                  "searches of the whole network after the first one; 2 if not given"),
            field("rings", &Aodv::rings, "whether a search begins with small TTLs"),
            field("destination_only", &Aodv::destination_only,
                  "whether only the destination may answer a request"),
            field("gratuitous", &Aodv::gratuitous,
                  "whether a node that answers tells the destination the way back"),
            field("hello", &Aodv::hello, seconds_range,
                  "time between HELLO packets; 0: the link layer reports broken links"),
            field("local_repair", &Aodv::local_repair,
                  "whether a node near the destination searches a new way"),
            field("buffer", &Aodv::buffer, Range{.low = 1, .high = 1e6, .text = "from 1 to 1e6"},
                  "packets that may wait at a node for routes"),
            field("ttl", &Aodv::ttl, Range{.low = 1, .high = 65535, .text = "from 1 to 65535"},
                  "hops that a message may cross; 64 if not given"),
            field("jitter", &Aodv::jitter, Range{.low = 0, .high = 1e9, .text = "from 0 to 1e9 s"},
                  "upper end of the uniform delay before a request is forwarded"));
    }

    operator Router() const;
};

}  // namespace rovernet
