// SPDX-License-Identifier: MIT
#pragma once

#include "traces/metric_values.hpp"
#include "traces/ns2/ns2_file.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {

/// Grouping of the rows of a TraceStats: none, or one row for each robot, flow or second.
enum class TraceRows { none, robot, flow, second };

/// Row of trace statistics: counts for one robot, one flow or one second of the trace.
struct TraceRow {
    /// Name of the row: number of the robot; or type and addresses of the flow, "cbr 5:0 -> 3:1";
    /// or second since the start of the run.
    std::string name;
    std::uint64_t messages = 0;       ///< messages sent: by the robot, of the flow or in the second
    std::uint64_t expected = 0;       ///< deliveries expected of the flow; 0 for a robot or second
    std::uint64_t deliveries = 0;     ///< deliveries: at the robot, of the flow or in the second
    std::uint64_t bytes = 0;          ///< size of the delivered messages [bytes]
    std::uint64_t delay_ns = 0;       ///< sum of the deliveries' latencies [ns]
    std::uint64_t transmissions = 0;  ///< transmissions: by the robot, of the flow or in the second
    std::uint64_t receptions = 0;     ///< copies received, including duplicates
    std::uint64_t drops = 0;          ///< copies lost or not forwarded
};

/// Statistics of an ns-2 trace.
///
/// A packet of an application is a packet that read_ns2_trace() converts to a message. A flow
/// consists of the packets of one type, source and destination, with their ports.
struct TraceStats {
    MetricValues metrics;  ///< metrics as in summary.json
    Ns2Counts counts;

    /// Copies of messages lost or not forwarded, by reason: reasons of sim/fate.hpp in their order,
    /// then other reasons of ns-2.
    std::vector<std::pair<std::string, std::uint64_t>> drops;
    /// Number of `D` lines of all packets, by layer and reason.
    std::map<std::pair<std::string, std::string>, std::uint64_t> drops_by_layer;

    /// Number of transmissions of control packets by routing agents: `s RTR` and `f RTR` lines from
    /// port 255, or of the type of a routing protocol (AODV, DSR, ...); each hop counts.
    std::uint64_t routing_packets = 0;
    std::uint64_t routing_bytes = 0;  ///< size of the routing packets, as in the lines [bytes]
    /// Number of transmissions of unicasts by routing agents: `s RTR` and `f RTR` lines of messages
    /// to one robot, except unicasts that rovernet sent over one hop without a routing protocol.
    std::uint64_t data_transmissions = 0;
    std::uint64_t delivered_bytes = 0;  ///< sum of the sizes of the delivered messages [bytes]

    // Jitter of the latencies d of one flow at one receiver, in the order of arrival.
    std::optional<double> jitter_mean;  ///< mean of |d_i - d_(i-1)| [s], d_i: consecutive latencies
    std::optional<double>
        jitter_rfc3550;               ///< interarrival jitter J [s] (RFC 3550, 6.4.1), averaged
                                      ///< over flows and receivers: final value of
                                      ///< J += (|d_i - d_(i-1)| - J) / 16, d_i as in jitter_mean
    std::optional<double> jitter_sd;  ///< standard deviation of all latencies (n - 1) [s]

    /// Throughput [bit/s]: bits of the delivered messages / (time from the first message sent,
    /// `s AGT`, to the last delivery).
    std::optional<double> throughput;

    std::vector<TraceRow> rows;  ///< rows of robots and seconds by number, of flows in the order of
                                 ///< their first messages
};

/// Computes the statistics of an ns-2 trace. Memory grows with robots and messages, by 8 bytes per
/// delivery, and by 40 bytes for each flow at each of its receivers; not with lines.
/// @throws InputError as read_ns2_trace()
TraceStats ns2_stats(Ns2Source source, Ns2Strictness = Ns2Strictness::tolerant,
                     TraceRows rows = TraceRows::none);

}  // namespace rovernet
