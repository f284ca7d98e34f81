// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fate.hpp"
#include "sim/fields.hpp"
#include "sim/time.hpp"
#include "traces/cost_values.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace rovernet {

/// Number of copies of messages that were lost for one reason.
struct DropCount {
    std::string_view reason;  ///< code of the reason, as in an ns-2 trace
    std::uint64_t count = 0;
    friend bool operator==(const DropCount&, const DropCount&) = default;
};

/// Latencies of deliveries: from the sending of the message to its first copy at a robot [s].
/// Percentiles by nearest rank: the p-th is the ceil(p n / 100)-th smallest of the n latencies.
struct LatencyValues {
    double mean = 0;  ///< mean latency [s]
    double p50 = 0;   ///< median latency [s]
    double p95 = 0;   ///< 95th percentile [s]
    double max = 0;   ///< largest latency [s]

    static constexpr auto fields() {
        return describe(
            field("latency_mean_s", &LatencyValues::mean, "mean latency"),
            field("latency_p50_s", &LatencyValues::p50, "median latency"),
            field("latency_p95_s", &LatencyValues::p95, "95th percentile of the latency"),
            field("latency_max_s", &LatencyValues::max, "largest latency"));
    }
    friend bool operator==(const LatencyValues&, const LatencyValues&) = default;
};

/// Codes of all reasons for which a copy is lost or not forwarded, without repetition: the order of
/// MetricValues::drops. DUP (duplicate) is first; further reasons are ordered as in sim/fate.hpp.
inline constexpr auto loss_codes = [] {
    struct Codes {
        std::array<std::string_view, 24> of{};
        std::size_t count = 0;
        constexpr std::size_t place(std::string_view code) const {
            std::size_t i = 0;
            while (i < count && of[i] != code) ++i;
            return i;
        }
        constexpr void add(std::string_view code) {
            if (!code.empty() && place(code) == count) of[count++] = code;
        }
    } codes;
    codes.add(reason_of(Fate::duplicate).code);
    for_each_reason([&](auto reason) { codes.add(reason_of(reason).code); });
    return codes;
}();

/// Numbers of copies lost or not forwarded, by the codes of the reasons in sim/fate.hpp.
using DropCounts = std::array<DropCount, loss_codes.count>;

/// Metrics of a part of the traffic, as summary.json has them for each flow and each robot.
struct PartMetrics {
    std::uint64_t messages = 0;            ///< messages sent in the flow, or to the robot
    std::uint64_t deliveries = 0;          ///< first copies of a message at a robot
    std::optional<double> delivery_ratio;  ///< delivery ratio [-]; empty: no delivery expected
    std::optional<double> throughput_bps;  ///< throughput [bit/s]; empty if the run takes no time
    std::optional<double> latency_mean_s;  ///< mean latency [s]; empty without deliveries

    static constexpr auto fields() {
        using P = PartMetrics;
        return describe(field("messages", &P::messages,
                              "messages that were sent in this flow, or to this robot"),
                        field("deliveries", &P::deliveries,
                              "deliveries of messages to robots; a message counts once for each "
                              "robot that it reached"),
                        field("delivery_ratio", &P::delivery_ratio,
                              "deliveries, divided by the number of deliveries that were possible"),
                        field("throughput_bps", &P::throughput_bps, "delivered bits per second"),
                        field("latency_mean_s", &P::latency_mean_s, "mean latency"));
    }
};

/// Values of a part of the traffic: the messages of one flow, or the messages for one robot.
/// Example: examples/flows.cpp.
struct PartValues {
    std::uint64_t messages = 0;    ///< messages sent in the flow, or to the robot
    std::uint64_t expected = 0;    ///< deliveries if every message reached all its destinations
    std::uint64_t deliveries = 0;  ///< first copies of a message at a robot
    std::uint64_t bytes = 0;       ///< size of the delivered messages [bytes]
    std::uint64_t delay_ns = 0;    ///< sum of the deliveries' latencies [ns]
    RoutedSums routed = {};        ///< sums over the flow's routed unicasts
    /// Numbers of lost copies of routed unicasts, by index in loss_codes; empty without losses.
    std::vector<std::uint64_t> drops = {};
    std::optional<double> delivery_ratio() const;  ///< delivery ratio [-]; empty if `expected` is 0
    std::optional<double> latency_mean() const;    ///< mean latency [s]; empty without deliveries
    /// Metrics of the part of the traffic. @param measured  duration of the measurement
    PartMetrics metrics(Duration measured) const;
    friend bool operator==(const PartValues&, const PartValues&) = default;
};

/// Parts of the traffic that Metrics measure in addition to the totals.
struct MetricParts {
    /// Whether the metric reach (deliveries over connected robots) is measured, by a search of the
    /// network for every message; empty: only while the search is cheap.
    std::optional<bool> reach = {};
    bool flows = false;         ///< true: measure the messages of each flow, see Message::flow
    bool robots = false;        ///< true: measure the messages for each robot
    bool path_stretch = false;  ///< true: measure hops over shortest path, by a search per unicast
};

/// Metrics of a run, or of a trace read back. All are computed from integers, whose sums are exact.
/// So no metric depends on how the receptions of a frame are split into Received records.
///
/// Names in summary.json and in studies, and their order, are those of fields(). A metric that is
/// added to fields() needs its computation in Metrics only.
struct MetricValues {
    std::uint64_t messages = 0;       ///< messages sent by applications
    std::uint64_t transmissions = 0;  ///< number of frames transmitted
    std::uint64_t receptions = 0;     ///< number of decoded copies, including duplicates
    std::uint64_t deliveries = 0;     ///< first copies of a message at a robot, for its application
    std::uint64_t delivered_bytes = 0;  ///< size of the messages delivered [bytes]

    /// Number of messages of which no frame had ended when the run ended: no robot could receive
    /// these. They count in `messages` and drops.END, but not in delivery_ratio and reach.
    std::uint64_t cut_off = 0;

    /// Numbers of copies lost or not forwarded, by the codes of the reasons in sim/fate.hpp.
    DropCounts drops = [] {
        DropCounts none;
        for (std::size_t i = 0; i < none.size(); ++i) none[i].reason = loss_codes.of[i];
        return none;
    }();

    /// Packet delivery ratio r / e [-]: r is the number of deliveries, without duplicates; e is the
    /// total number of destinations of all messages. A unicast has one destination; a broadcast has
    /// all robots that existed when it was sent, except its sender. Empty if e is 0. Messages cut
    /// off by the end of the run are not included. Source: for unicasts, J. Broch et al., MobiCom
    /// 1998.
    std::optional<double> delivery_ratio;

    /// Reachability RE = r / e [-]: r is the number of deliveries; e is the total number, over all
    /// messages, of robots that a chain of links connected to the sender when it sent the message
    /// (for a unicast only the destination counts). RE can exceed 1, because robots that move or
    /// forward late may reach further robots. Empty if e is 0 or was not measured for every
    /// message. Source: S.-Y. Ni et al., The broadcast storm problem, MobiCom 1999.
    std::optional<double> reach;
    bool reach_known = true;  ///< true if connected robots were counted for every message

    /// Saved rebroadcasts SRB = (r - t) / r [-] of broadcasts: r is the number of their deliveries;
    /// t is the number of different (message, robot) pairs in which the robot, other than the
    /// message's origin, transmitted it. Empty if r is 0. Source: S.-Y. Ni et al., MobiCom 1999.
    std::optional<double> saved_rebroadcasts;

    std::optional<LatencyValues> latency;  ///< latency of the deliveries; empty without deliveries
    std::optional<double> mean_hops;  ///< mean hops of a delivery [-]; empty without deliveries
    std::uint32_t max_hops = 0;       ///< largest number of hops of a delivery [-]
    std::vector<std::uint64_t> hops;  ///< number of deliveries after h hops, h = 0 ... max_hops

    /// Cost of the routing protocol, and metrics of the unicasts that it routes; empty if it sent
    /// no control packets and no message to one robot.
    std::optional<RoutingValues> routing;
    std::optional<RoutedMetrics> routed;

    std::vector<PartValues> flows;   ///< values of each flow, at index flow - 1, if measured
    std::vector<PartValues> robots;  ///< values of each robot, by its id, if measured

    static constexpr auto fields() {
        using M = MetricValues;
        return describe(
            field("messages", &M::messages, "messages sent by applications"),
            field("cut_off", &M::cut_off,
                  "messages whose first frame had not ended when the run ended; delivery_ratio "
                  "does not count these messages"),
            field("transmissions", &M::transmissions, "frames transmitted"),
            field("receptions", &M::receptions, "copies of messages that robots decoded"),
            field("deliveries", &M::deliveries,
                  "deliveries of messages to robots; a message counts once for each robot that it "
                  "reached"),
            field("delivery_ratio", &M::delivery_ratio,
                  "deliveries, divided by the number of deliveries that were possible"),
            field("reach", &M::reach,
                  "deliveries, divided by the number of robots to which the sender had a link, "
                  "directly or over other robots"),
            field("saved_rebroadcasts", &M::saved_rebroadcasts,
                  "share of receiving robots that did not forward a broadcast"),
            field("latency", &M::latency, "latency of the deliveries"),
            field("hops_mean", &M::mean_hops, "mean number of hops of a delivery"),
            field("hops_max", &M::max_hops, "largest number of hops of a delivery"),
            field("routing", &M::routing, "cost of the routing protocol"),
            field("routed", &M::routed, "paths and delays of routed unicasts"),
            field("drops", &M::drops, "lost copies of messages, for each reason of the loss"));
    }

    friend bool operator==(const MetricValues&, const MetricValues&) = default;
};

/// Airtime values of a run. @param total  sum of the airtimes of all frames [ns]
inline AirtimeValues airtime_values(Duration total, const MetricValues& metrics) {
    AirtimeValues values{.total = seconds(total), .per_byte = std::nullopt};
    const auto bytes = static_cast<double>(metrics.delivered_bytes);
    if (bytes > 0) values.per_byte = 1e6 * values.total / bytes;
    return values;
}

}  // namespace rovernet
