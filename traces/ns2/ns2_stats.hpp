// SPDX-License-Identifier: MIT
#pragma once

#include "traces/metric_values.hpp"
#include "traces/ns2/ns2_file.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rovernet {

/// What the rows of a TraceStats are about.
enum class TraceRows { none, robot, flow, second };

/// Counts of one robot, one flow or one second.
struct TraceRow {
    /// Number of the robot; type and addresses of the flow, "cbr 5:0 -> 3:1"; second from the start
    /// of the run.
    std::string name;
    std::uint64_t messages = 0;       ///< sent by the robot, in the flow, in the second
    std::uint64_t expected = 0;       ///< deliveries that the flow should have; of flows only
    std::uint64_t deliveries = 0;     ///< at the robot, of the flow, in the second
    std::uint64_t bytes = 0;          ///< [bytes] of the messages delivered
    std::uint64_t delay_ns = 0;       ///< [ns] sum of their latencies
    std::uint64_t transmissions = 0;  ///< by the robot, of the flow, in the second
    std::uint64_t receptions = 0;     ///< copies received, duplicates included
    std::uint64_t drops = 0;          ///< copies that went no further
};

/// Everything that is counted of an ns-2 trace.
///
/// A packet of an application is what read_ns2_trace() makes a message of. A flow has the packets
/// of one type, source and destination with their ports.
struct TraceStats {
    MetricValues metrics;  ///< as in summary.json
    Ns2Counts counts;

    /// Copies of messages that went no further, by reason: those of sim/fate.hpp in their order,
    /// then others of ns-2.
    std::vector<std::pair<std::string, std::uint64_t>> drops;
    /// All `D` lines, of any packet, by layer and reason.
    std::map<std::pair<std::string, std::string>, std::uint64_t> drops_by_layer;

    /// Transmissions by routing agents of their own packets: `s RTR` and `f RTR` lines from port
    /// 255, or of a type that is a routing protocol's (AODV, DSR, ...); each hop counts.
    std::uint64_t routing_packets = 0;
    std::uint64_t routing_bytes = 0;    ///< [bytes] of these, as the lines have them
    std::uint64_t delivered_bytes = 0;  ///< [bytes] of the messages at each delivery

    // Jitter of the latencies d of one flow at one receiver, in the order of their arrival.
    std::optional<double> jitter_mean;  ///< [s] mean of |d_i - d_(i-1)| over all of them
    std::optional<double>
        jitter_rfc3550;               ///< [s] J += (|d_i - d_(i-1)| - J) / 16 (RFC 3550, 6.4.1),
                                      ///< at its end, averaged over flows and receivers
    std::optional<double> jitter_sd;  ///< [s] standard deviation of all latencies (n - 1)

    /// Bits of the messages delivered / (time from the first `s AGT` to the last delivery) [bit/s].
    std::optional<double> throughput;

    std::vector<TraceRow>
        rows;  ///< robots and seconds by their number, flows by their first message
};

/// Counts a trace. Memory grows with robots, messages and, by 8 bytes, deliveries; by 40 bytes more
/// for each flow at each of its receivers; not with lines.
/// @throws InputError as read_ns2_trace()
TraceStats ns2_stats(Ns2Source source, Ns2Strictness = Ns2Strictness::tolerant,
                     TraceRows rows = TraceRows::none);

}  // namespace rovernet
