// SPDX-License-Identifier: MIT
#include "traces/metrics.hpp"

#include "sim/legs.hpp"

#include <algorithm>

namespace rovernet {
namespace {

/// Percentile p by nearest rank, of n > 0 sorted latencies [s].
double percentile(const std::vector<Duration>& sorted, std::size_t p) {
    const std::size_t rank = (p * sorted.size() + 99) / 100;
    return seconds(sorted[rank - 1]);
}

std::optional<LatencyValues> latency_of(std::vector<Duration> delays) {
    if (delays.empty()) return std::nullopt;
    std::sort(delays.begin(), delays.end());
    std::uint64_t sum = 0;  // [ns]; 584 years
    for (const Duration d : delays) sum += static_cast<std::uint64_t>(d.count());
    return LatencyValues{
        .mean = static_cast<double>(sum) / static_cast<double>(delays.size()) / 1e9,
        .p50 = percentile(delays, 50),
        .p95 = percentile(delays, 95),
        .max = seconds(delays.back())};
}

std::optional<double> ratio(std::uint64_t part, std::uint64_t whole) {
    if (whole == 0) return std::nullopt;
    return static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

std::optional<double> PartValues::delivery_ratio() const { return ratio(deliveries, expected); }
std::optional<double> PartValues::latency_mean() const {
    if (deliveries == 0) return std::nullopt;
    return static_cast<double>(delay_ns) / static_cast<double>(deliveries) / 1e9;
}

PartMetrics PartValues::metrics(Duration measured) const {
    const double bits = 8 * static_cast<double>(bytes);
    return {.messages = messages,
            .deliveries = deliveries,
            .delivery_ratio = delivery_ratio(),
            .throughput_bps =
                measured > Duration{0} ? std::optional(bits / seconds(measured)) : std::nullopt,
            .latency_mean_s = latency_mean()};
}

Metrics::MessageState& Metrics::begin_state(MessageId id, std::uint64_t uid) {
    if (id.index() >= states_.size()) states_.resize(id.index() + 1);
    MessageState& state = states_[id.index()];
    state.forwarders.clear();
    state.uid = uid;
    state.others = 0;
    state.reachable.reset();
    return state;
}

PartValues& Metrics::flow(const Message& message) {
    if (message.flow > flows_.size()) flows_.resize(message.flow);
    return flows_[message.flow - 1];
}

PartValues& Metrics::robot(NodeId node) {
    if (node.index() >= robots_.size()) robots_.resize(node.index() + 1);
    return robots_[node.index()];
}

void Metrics::on(const Record& record, const RecordContext& context) {
    if (const auto* received = std::get_if<Received>(&record)) {
        count(*received, context);
    } else if (const auto* transmitted = std::get_if<Transmitted>(&record)) {
        count(*transmitted, context);
    } else if (const auto* sent = std::get_if<Sent>(&record)) {
        count(*sent, context);
    } else if (const auto* dropped = std::get_if<Dropped>(&record)) {
        count(*dropped, context);
    } else if (const auto* routed = std::get_if<Routed>(&record)) {
        count_routed(routed->frame, routed->time, context);
    }
}

/// Counts a frame that the routing protocol sends over a hop: a unicast, or a control packet.
void Metrics::count_routed(const Frame& frame, Time time, const RecordContext& context) {
    const Message& message = context.messages[frame.message];
    if (message.kind.empty()) {
        routing_.data += message.is_routed && message.created >= begin_ ? 1 : 0;
    } else if (time >= begin_) {
        ++routing_.packets;
        routing_.bytes += frame.bytes > 0 ? frame.bytes : message.size;
    }
}

/// Adds a message to the counts of its destinations, or removes one that was cut off.
void Metrics::count_parts(const Message& message, std::uint64_t others, bool is_cut_off) {
    const std::uint64_t one = is_cut_off ? ~std::uint64_t{0} : 1;  // modulo 2^64
    if (parts_.flows && message.flow > 0) {
        flow(message).messages += is_cut_off ? 0 : 1;
        flow(message).expected += one * others;
    }
    if (!parts_.robots) return;
    if (message.to != everyone) {
        robot(message.to).messages += one;
        return;
    }
    broadcasts_ += one;
    const std::size_t origin = message.origin.index();
    if (origin >= own_broadcasts_.size()) own_broadcasts_.resize(origin + 1);
    own_broadcasts_[origin] += one;
}

void Metrics::count(const Dropped& dropped, const RecordContext& context) {
    if (dropped.protocol_decides || !counts(dropped.frame, context)) return;
    ++drops_[dropped.reason];
    if (dropped.reason != DropReason::cut_off) return;
    const MessageState& state = state_of(dropped.frame.message, context);
    ++totals_.cut_off;
    others_ -= state.others;
    reachable_ -= state.reachable.value_or(0);
    count_parts(context.messages[dropped.frame.message], state.others, true);
}

void Metrics::count(const Sent& sent, const RecordContext& context) {
    if (sent.time < begin_) return;
    ++totals_.messages;
    MessageState& state = state_of(sent.message, context);
    state.others = std::max(sent.robots, 1U) - 1;
    state.reachable = sent.reachable;
    if (!sent.reachable) totals_.reach_known = false;
    others_ += state.others;
    reachable_ += sent.reachable.value_or(0);
    count_parts(context.messages[sent.message], state.others, false);
}

void Metrics::count(const Transmitted& transmitted, const RecordContext& context) {
    const Frame& frame = transmitted.frame;
    if (frame.next_hop == everyone && !context.messages[frame.message].kind.empty()) {
        count_routed(frame, transmitted.time, context);
    }
    if (!counts(frame, context)) return;
    ++totals_.transmissions;
    if (frame.sender == context.messages[frame.message].origin) return;
    auto& bits = state_of(frame.message, context).forwarders;
    const std::size_t word = frame.sender.index() / 64;
    const std::uint64_t bit = std::uint64_t{1} << (frame.sender.index() % 64);
    if (word >= bits.size()) bits.resize(std::max(word + 1, context.legs.size() / 64 + 1));
    if (!(bits[word] & bit)) ++forwarders_;
    bits[word] |= bit;
}

void Metrics::count(const Received& received, const RecordContext& context) {
    if (!counts(received.frame, context)) return;
    for (const Reception& rx : received.receptions) {
        ++fates_[rx.fate];
        if (rx.delivered) deliver(rx, received.frame, context);
    }
}

void Metrics::deliver(const Reception& rx, const Frame& frame, const RecordContext& context) {
    const Message& message = context.messages[frame.message];
    const Duration delay = rx.time - message.created;
    ++totals_.deliveries;
    if (hops_.size() <= frame.hops) hops_.resize(frame.hops + std::size_t{1});
    ++hops_[frame.hops];
    delays_.push_back(delay);
    bytes_ += message.size;
    if (state_of(frame.message, context).reachable) ++reached_;
    const auto add_to = [&](PartValues& part) {
        ++part.deliveries;
        part.bytes += message.size;
        part.delay_ns += static_cast<std::uint64_t>(delay.count());
    };
    if (parts_.flows && message.flow > 0) add_to(flow(message));
    if (parts_.robots) add_to(robot(rx.node));
}

std::vector<PartValues> Metrics::robots() const {
    std::vector<PartValues> all = robots_;
    all.resize(std::max(all.size(), own_broadcasts_.size()));
    for (std::size_t i = 0; i < all.size(); ++i) {
        all[i].messages += broadcasts_ - (i < own_broadcasts_.size() ? own_broadcasts_[i] : 0);
        all[i].expected = all[i].messages;
    }
    return all;
}

MetricValues Metrics::values() const {
    MetricValues v = totals_;
    const auto add = [&](LossReason reason, std::uint64_t count) {
        if (!reason.code.empty()) v.drops[loss_codes.place(reason.code)].count += count;
    };
    for_each_reason([&](auto reason) {
        if constexpr (std::is_same_v<decltype(reason), Fate>) {
            const std::uint64_t count = fates_[reason];
            add(reason_of(reason), count);
            if (is_decoded(reason)) v.receptions += count;
        } else {
            add(reason_of(reason), drops_[reason]);
        }
    });
    v.flows = flows_;
    v.delivered_bytes = bytes_;
    if (routing_.packets + routing_.data > 0) {
        v.routing = routing_;
        v.routing->load = ratio(routing_.packets, v.deliveries);
        v.routing->load_bytes = ratio(routing_.bytes, bytes_);
    }
    if (parts_.robots) v.robots = robots();
    v.delivery_ratio = ratio(v.deliveries, others_);
    if (v.reach_known) v.reach = ratio(reached_, reachable_);
    // Signed numbers, because t may exceed r: robots that are not counted in r may forward.
    const auto saved = static_cast<double>(v.deliveries) - static_cast<double>(forwarders_);
    if (v.deliveries > 0) v.saved_rebroadcasts = saved / static_cast<double>(v.deliveries);
    v.latency = latency_of(delays_);
    std::uint64_t sum = 0;
    for (std::uint32_t h = 0; h < hops_.size(); ++h) {
        sum += h * hops_[h];
        if (hops_[h] > 0) v.max_hops = h;
    }
    v.mean_hops = ratio(sum, v.deliveries);
    if (v.deliveries > 0) v.hops.assign(hops_.begin(), hops_.begin() + v.max_hops + 1);
    return v;
}

}  // namespace rovernet
