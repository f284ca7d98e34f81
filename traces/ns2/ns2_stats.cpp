// SPDX-License-Identifier: MIT
#include "traces/ns2/ns2_stats.hpp"

#include "traces/metrics.hpp"
#include "traces/ns2/ns2_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <unordered_map>  // order never observed
#include <utility>

namespace rovernet {
namespace {

bool is_of_routing(const Ns2Packet& p) {
    constexpr std::string_view types[] = {"AODV", "AOMDV", "DSR",  "DSDV", "TORA",
                                          "IMEP", "OLSR",  "PUMA", "MDART"};
    return (p.ip && p.ip->from_port == routing_port) ||
           std::find(std::begin(types), std::end(types), p.type) != std::end(types);
}

/// Mean difference, running average and deviation of latencies.
class Jitter {
  public:
    void add(std::uint32_t flow, NodeId receiver, Duration delay) {
        const std::uint64_t key = std::uint64_t{flow} << 32 | receiver.value;
        const auto [entry, is_new] = place_.try_emplace(key, streams_.size());
        if (is_new) {
            streams_.push_back({delay, 0, 0});
        } else {
            Stream& stream = streams_[entry->second];
            const Duration change = std::chrono::abs(delay - stream.last);
            stream.last = delay;
            ++stream.changes;
            stream.running += (seconds(change) - stream.running) / 16;
            changed_ns_ += static_cast<std::uint64_t>(change.count());
            ++changes_;
        }
        ++count_;
        const double d = seconds(delay), before = d - mean_;
        mean_ += before / static_cast<double>(count_);
        squares_ += before * (d - mean_);
    }
    void tell(TraceStats& stats) const {
        if (count_ > 1) stats.jitter_sd = std::sqrt(squares_ / static_cast<double>(count_ - 1));
        if (changes_ == 0) return;
        stats.jitter_mean = static_cast<double>(changed_ns_) / static_cast<double>(changes_) / 1e9;
        double sum = 0;
        std::uint64_t n = 0;
        for (const Stream& stream : streams_) {
            if (stream.changes == 0) continue;
            sum += stream.running;
            ++n;
        }
        stats.jitter_rfc3550 = sum / static_cast<double>(n);
    }

  private:
    /// Deliveries of one flow at one receiver.
    struct Stream {
        Duration last;
        std::uint32_t changes;
        double running;  ///< [s]
    };
    std::unordered_map<std::uint64_t, std::size_t> place_;
    std::vector<Stream> streams_;  ///< in the order of their first delivery
    std::uint64_t changed_ns_ = 0, changes_ = 0, count_ = 0;
    double mean_ = 0, squares_ = 0;  ///< [s], [s^2]; Welford's
};

/// Counts what Metrics does not.
class TraceCounter {
  public:
    explicit TraceCounter(TraceRows by) : by_(by) {}

    KindMask kinds() const {
        return kind_of<Sent>() | kind_of<Transmitted>() | kind_of<Received>();
    }
    void on(const Record& record, const RecordContext& context) {
        if (const auto* s = std::get_if<Sent>(&record)) {
            sent(*s, context.messages[s->message]);
        } else if (const auto* t = std::get_if<Transmitted>(&record)) {
            const Message& message = context.messages[t->frame.message];
            if (TraceRow* r = row(t->frame.sender, message.flow, t->time)) ++r->transmissions;
        } else if (const auto* r = std::get_if<Received>(&record)) {
            const Message& message = context.messages[r->frame.message];
            for (const Reception& rx : r->receptions) received(rx, message);
        }
    }
    void packet(const Ns2Packet& p, const Message* message);
    /// The counts, into `stats`, which has the metrics already.
    void tell(TraceStats& stats);

  private:
    void sent(const Sent& s, const Message& message) {
        if (!is_any_sent_) first_sent_ = s.time;
        is_any_sent_ = true;
        if (TraceRow* r = row(s.node, message.flow, s.time)) ++r->messages;
    }
    void received(const Reception& rx, const Message& message);
    TraceRow* row(NodeId node, std::uint32_t flow, Time time) {
        switch (by_) {
            case TraceRows::none: return nullptr;
            case TraceRows::robot: return &rows_[node.value];
            case TraceRows::flow: return &rows_[flow];
            case TraceRows::second: break;
        }
        constexpr std::int64_t ns_per_s = 1'000'000'000;
        return &rows_[static_cast<std::uint64_t>(time.time_since_epoch().count() / ns_per_s)];
    }

    TraceRows by_;
    TraceStats counted_;
    std::map<std::string, std::uint64_t, std::less<>> drops_;
    std::map<std::uint64_t, TraceRow> rows_;
    Jitter jitter_;
    Time first_sent_, last_delivered_;
    bool is_any_sent_ = false;
};

void TraceCounter::received(const Reception& rx, const Message& message) {
    TraceRow* r = row(rx.node, message.flow, rx.time);
    if (r && is_decoded(rx.fate)) ++r->receptions;
    if (!rx.delivered) return;
    const Duration delay = rx.time - message.created;
    jitter_.add(message.flow, rx.node, delay);
    last_delivered_ = rx.time;
    counted_.delivered_bytes += message.size;
    if (!r) return;
    ++r->deliveries;
    r->bytes += message.size;
    r->delay_ns += static_cast<std::uint64_t>(delay.count());
}

void TraceCounter::packet(const Ns2Packet& p, const Message* message) {
    if (p.op == 'D') {
        ++counted_.drops_by_layer[{std::string(p.layer), std::string(p.reason)}];
        if (!message) return;
        ++drops_[std::string(p.reason)];
        if (TraceRow* r = row(p.node, message->flow, p.time)) ++r->drops;
        return;
    }
    const bool is_sent = p.layer == "RTR" && (p.op == 's' || p.op == 'f');
    if (is_sent && !message && is_of_routing(p)) {
        ++counted_.routing_packets;
        counted_.routing_bytes += p.size.value_or(0);
    }
    if (by_ != TraceRows::flow || !message || p.layer != "AGT" || p.op != 's') return;
    rows_[message->flow].name = fmt::format("{} {}:{} -> {}:{}", p.type, p.ip->from,
                                            p.ip->from_port, p.ip->to, p.ip->to_port);
}

void TraceCounter::tell(TraceStats& stats) {
    MetricValues metrics = std::move(stats.metrics);
    Ns2Counts counts = std::move(stats.counts);
    stats = counted_;
    for (const std::string_view code : loss_codes.of) {
        const auto found = drops_.find(code);
        if (code.empty() || found == drops_.end()) continue;
        stats.drops.push_back(*found);
        drops_.erase(found);
    }
    stats.drops.insert(stats.drops.end(), drops_.begin(), drops_.end());
    jitter_.tell(stats);
    const double duration = seconds(last_delivered_ - first_sent_);
    if (stats.delivered_bytes > 0 && duration > 0) {
        stats.throughput = 8 * static_cast<double>(stats.delivered_bytes) / duration;
    }
    for (auto& [number, row] : rows_) {
        if (row.name.empty()) row.name = std::to_string(number);
        if (by_ == TraceRows::flow && number >= 1 && number <= metrics.flows.size()) {
            row.expected = metrics.flows[number - 1].expected;
        }
        stats.rows.push_back(row);
    }
    stats.metrics = std::move(metrics);
    stats.counts = std::move(counts);
}

/// Gives each record to both.
struct MetricsAndCounter {
    Metrics metrics;
    TraceCounter counter;

    KindMask kinds() const { return metrics.kinds() | counter.kinds(); }
    void on(const Record& record, const RecordContext& context) {
        metrics.on(record, context);
        counter.on(record, context);
    }
};

}  // namespace

TraceStats ns2_stats(Ns2Source source, Ns2Strictness strictness, TraceRows rows) {
    const MetricParts parts{.flows = rows == TraceRows::flow};
    const auto both = std::make_shared<MetricsAndCounter>(
        MetricsAndCounter{Metrics(start_of_run, parts), TraceCounter(rows)});
    TraceStats stats;
    stats.counts = read_ns2_trace(
        std::move(source), both, strictness,
        [&](const Ns2Packet& p, const Message* message) { both->counter.packet(p, message); });
    stats.metrics = both->metrics.values();
    both->counter.tell(stats);
    return stats;
}

}  // namespace rovernet
