// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"

#include <cstdint>
#include <optional>

namespace rovernet {

/// Sums over the routed unicasts of a run or flow: messages to one robot that a routing protocol
/// forwards. All sums are whole numbers.
struct RoutedSums {
    std::uint64_t transmissions = 0;  ///< transmissions of routed unicasts, one for each hop
    std::uint64_t deliveries = 0;     ///< number of delivered routed unicasts
    std::uint64_t waited_ns = 0;      ///< time of delivered messages in routers [ns], until their
                                      ///< frames were passed to the MAC, at source and each hop
    std::uint64_t delay_ns = 0;       ///< sum of the latencies [ns], including time in routers
    std::uint64_t hops = 0;           ///< hops of the deliveries with a known shortest path
    std::uint64_t shortest = 0;       ///< hops of the shortest paths for the deliveries of `hops`
    friend bool operator==(const RoutedSums&, const RoutedSums&) = default;
};

/// Metrics of routed unicasts (messages to one robot that a routing protocol forwards), as
/// summary.json has them for the run and for each flow.
struct RoutedMetrics {
    std::uint64_t data = 0;              ///< transmissions of routed unicasts, one for each hop
    std::optional<double> path_stretch;  ///< hops over shortest-path hops [-]; empty: not measured
    std::optional<double> waiting;       ///< mean time in routers of a delivered message [s]
    std::optional<double> travelling;    ///< mean latency without the time in routers [s]

    static constexpr auto fields() {
        using R = RoutedMetrics;
        return describe(
            field("data_transmissions", &R::data, "transmissions of unicasts; each hop counts"),
            field("path_stretch", &R::path_stretch,
                  "hops of routed unicasts, divided by the hops of the shortest path"),
            field("delay_waiting", &R::waiting, "mean time that a message waits in routers"),
            field("delay_travelling", &R::travelling,
                  "mean time that a message travels between routers"));
    }
    friend bool operator==(const RoutedMetrics&, const RoutedMetrics&) = default;
};

/// Metrics of routed messages from their sums.
RoutedMetrics metrics_of(const RoutedSums& sums);

/// Cost of a routing protocol. A packet counts once for each hop, as lines s and f at RTR in ns-2.
/// Source: J. Broch et al., A performance comparison of multi-hop wireless ad hoc network routing
/// protocols, MobiCom 1998.
struct RoutingValues {
    std::uint64_t packets = 0;         ///< control packets that the protocol sent
    std::uint64_t bytes = 0;           ///< size of the control packets, above the MAC [bytes]
    std::optional<double> load;        ///< control packets per delivery [-]; empty: no delivery
    std::optional<double> load_bytes;  ///< control bytes for each delivered byte [-]
    /// Numbers of control packets by the last word of their kind: "AODV REQUEST" is a request. A
    /// packet of any other kind is not counted here.
    std::uint64_t requests = 0, replies = 0, errors = 0, hellos = 0;
    /// Number of link breaks, each detected when a routed message or a control packet failed.
    std::uint64_t broken = 0;

    static constexpr auto fields() {
        using R = RoutingValues;
        return describe(
            field("routing_packets", &R::packets,
                  "transmissions of control packets; each hop counts"),
            field("routing_bytes", &R::bytes, "bytes of all transmitted control packets"),
            field("routing_load", &R::load, "control packets divided by deliveries"),
            field("routing_load_bytes", &R::load_bytes,
                  "bytes of control packets divided by delivered bytes"),
            field("routing_requests", &R::requests, "control packets: requests"),
            field("routing_replies", &R::replies, "control packets: replies"),
            field("routing_errors", &R::errors, "control packets: errors"),
            field("routing_hellos", &R::hellos, "control packets: HELLOs"),
            field("routes_broken", &R::broken,
                  "links that broke while a packet was sent over them"));
    }
    friend bool operator==(const RoutingValues&, const RoutingValues&) = default;
};

/// Airtime of all frames of a run: messages, their copies, control packets and the control frames
/// of the access model.
struct AirtimeValues {
    double total = 0;                ///< sum of the frames' airtimes [s]
    std::optional<double> per_byte;  ///< airtime per delivered byte [us]; empty: nothing delivered

    static constexpr auto fields() {
        using A = AirtimeValues;
        return describe(
            field("airtime_s", &A::total, "sum of the airtimes of all frames"),
            field("airtime_per_byte_us", &A::per_byte, "airtime for each byte delivered"));
    }
    friend bool operator==(const AirtimeValues&, const AirtimeValues&) = default;
};

}  // namespace rovernet
