// SPDX-License-Identifier: MIT
#include "traces/ns2/trace_counter.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <utility>

namespace rovernet {

void Jitter::add(std::uint32_t flow, NodeId receiver, Duration delay) {
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

void Jitter::tell(TraceStats& stats) const {
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

void TraceCounter::sent(NodeId node, const Sending& message) {
    if (!is_any_sent_) first_sent_ = message.time;
    is_any_sent_ = true;
    if (TraceRow* r = row(node, message.flow, message.time)) ++r->messages;
}

void TraceCounter::received(const Reception& rx, const Sending& message) {
    TraceRow* r = row(rx.node, message.flow, rx.time);
    if (r && is_decoded(rx.fate)) ++r->receptions;
    if (!rx.delivered) return;
    const Duration delay = rx.time - message.time;
    jitter_.add(message.flow, rx.node, delay);
    last_delivered_ = rx.time;
    counted_.delivered_bytes += message.size;
    if (!r) return;
    ++r->deliveries;
    r->bytes += message.size;
    r->delay_ns += static_cast<std::uint64_t>(delay.count());
}

void TraceCounter::add_drops(std::string_view reason, std::uint64_t count) {
    if (count > 0) drops_[std::string(reason)] += count;
}

void TraceCounter::add_drops(std::string_view layer, std::string_view reason, std::uint64_t count) {
    if (count == 0) return;
    counted_.drops_by_layer[{std::string(layer), std::string(reason)}] += count;
}

void TraceCounter::routed(std::uint64_t bytes) {
    ++counted_.routing_packets;
    counted_.routing_bytes += bytes;
}

bool TraceCounter::is_of_routing(std::string_view type) {
    constexpr std::string_view types[] = {"AODV", "AOMDV", "DSR",  "DSDV", "TORA",
                                          "IMEP", "OLSR",  "PUMA", "MDART"};
    return std::find(std::begin(types), std::end(types), type) != std::end(types);
}

TraceRow& TraceCounter::new_row(std::uint64_t number) {
    constexpr std::uint64_t most_near = 1 << 20;  // a trace may say any second
    TraceRow& row = rows_[number];
    if (number >= most_near) return row;
    if (near_.size() <= number) near_.resize(number + 1);
    near_[number] = &row;
    return row;
}

void TraceCounter::tell(TraceStats& stats, const std::vector<PartValues>& flows) {
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
        if (by_ == TraceRows::flow && number >= 1 && number <= flows.size()) {
            row.expected = flows[number - 1].expected;
        }
        stats.rows.push_back(row);
    }
    stats.metrics = std::move(metrics);
    stats.counts = std::move(counts);
}

}  // namespace rovernet
