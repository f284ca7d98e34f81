// SPDX-License-Identifier: MIT
#pragma once

#include "sim/message.hpp"
#include "sim/record.hpp"
#include "traces/metric_values.hpp"
#include "traces/ns2/ns2_stats.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>  // order never observed
#include <vector>

namespace rovernet {

/// Jitter of latencies: mean difference of consecutive latencies, running average of RFC 3550, and
/// standard deviation.
class Jitter {
  public:
    void add(std::uint32_t flow, NodeId receiver, Duration delay);
    /// Writes the jitter so far into `stats`.
    void tell(TraceStats& stats) const;

  private:
    /// Deliveries of one flow at one receiver.
    struct Stream {
        Duration last;
        std::uint32_t changes;
        double running;  ///< running average of the jitter [s]
    };
    std::unordered_map<std::uint64_t, std::size_t> place_;
    std::vector<Stream> streams_;  ///< streams in the order of their first deliveries
    std::uint64_t changed_ns_ = 0, changes_ = 0, count_ = 0;
    double mean_ = 0, squares_ = 0;  ///< latencies: mean [s], sum of squared deviations [s^2]
};

/// Counters of trace statistics that Metrics do not have. Their input is the content of the lines
/// of an ns-2 trace: ns2_stats() reads the lines, recorded_stats() derives them from the records of
/// a recorded trace.
class TraceCounter {
  public:
    /// Data of a message that was sent in the trace.
    struct Sending {
        std::uint32_t flow = 0;  ///< number of the flow, from 1
        std::uint32_t size = 0;  ///< size of the message [bytes]
        Time time;               ///< time of sending
    };

    explicit TraceCounter(TraceRows by) : by_(by) {}
    TraceCounter(TraceCounter&&) = default;  // no copies: near_ points into rows_

    TraceRows by() const { return by_; }
    /// Adds the row of a robot of the trace, if rows are by robot and it has none yet.
    void know(NodeId node) {
        if (by_ == TraceRows::robot) row(node.value);
    }
    void sent(NodeId node, const Sending& message);
    void transmitted(NodeId sender, std::uint32_t flow, Time time) {
        if (TraceRow* r = row(sender, flow, time)) ++r->transmissions;
    }
    void received(const Reception& rx, const Sending& message);
    /// Counts a copy of a message that was lost or not forwarded.
    void lost(NodeId node, std::uint32_t flow, Time time) {
        if (TraceRow* r = row(node, flow, time)) ++r->drops;
    }
    /// Adds `count` copies of messages that were lost or not forwarded for the given reason.
    void add_drops(std::string_view reason, std::uint64_t count);
    /// Adds `count` dropped packets of any kind, by layer and reason.
    void add_drops(std::string_view layer, std::string_view reason, std::uint64_t count);
    /// Counts a control packet sent by a routing agent.
    void routed(std::uint64_t bytes);
    /// Counts a unicast sent or forwarded by a routing agent.
    void forwarded() { ++counted_.data_transmissions; }
    /// Whether packets of this type are control packets of a routing protocol.
    static bool is_of_routing(std::string_view type);
    /// Sets the name of a flow's row.
    void name_flow(std::uint32_t flow, const std::string& name) { rows_[flow].name = name; }

    /// Writes the counts into `stats`, which already has counts of lines and metrics.
    /// @param flows  values of each flow, at index flow - 1; only `expected` is used
    void tell(TraceStats& stats, const std::vector<PartValues>& flows);

  private:
    TraceRow* row(NodeId node, std::uint32_t flow, Time time) {
        switch (by_) {
            case TraceRows::none: return nullptr;
            case TraceRows::robot: return &row(node.value);
            case TraceRows::flow: return &row(flow);
            case TraceRows::second: break;
        }
        constexpr std::int64_t ns_per_s = 1'000'000'000;
        return &row(static_cast<std::uint64_t>(time.time_since_epoch().count() / ns_per_s));
    }
    TraceRow& row(std::uint64_t number) {
        return number < near_.size() && near_[number] ? *near_[number] : new_row(number);
    }
    TraceRow& new_row(std::uint64_t number);

    TraceRows by_;
    TraceStats counted_;
    std::map<std::string, std::uint64_t, std::less<>> drops_;
    std::map<std::uint64_t, TraceRow> rows_;
    std::vector<TraceRow*> near_;  ///< rows with a small number (robot, flow or second), by number
    Jitter jitter_;
    Time first_sent_, last_delivered_;
    bool is_any_sent_ = false;
};

}  // namespace rovernet
