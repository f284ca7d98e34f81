// SPDX-License-Identifier: MIT
#include "traces/metrics.hpp"

#include "sim/legs.hpp"
#include "sim/router.hpp"

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

/// Whether a frame that was lost for this reason shows that a link is broken.
bool breaks_link(DropReason reason) {
    return reason == DropReason::retries || reason == DropReason::unheard;
}

/// Whether the routing protocol is told of each attempt that failed, and decides what becomes of
/// the message. Every protocol of a scenario that routes unicasts is told of it.
bool hears_of_results(const RecordContext& context) {
    return !context.router || context.router->hears_of_results();
}

}  // namespace

RoutedMetrics metrics_of(const RoutedSums& sums) {
    constexpr double ns_per_s = 1e9;
    RoutedMetrics metrics{.data = sums.transmissions,
                          .path_stretch = ratio(sums.hops, sums.shortest),
                          .waiting = ratio(sums.waited_ns, sums.deliveries),
                          .travelling = ratio(sums.delay_ns - sums.waited_ns, sums.deliveries)};
    for (auto* mean : {&metrics.waiting, &metrics.travelling}) {
        if (*mean) **mean /= ns_per_s;
    }
    return metrics;
}

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
    state.shortest.reset();
    state.waited = {};
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
        count(*routed, context);
    }
}

/// Counts a control packet that the routing protocol sends over a hop.
void Metrics::count_packet(const Frame& frame, const Message& message, Time time) {
    if (time < begin_) return;
    ++routing_.packets;
    routing_.bytes += frame.size_of(message);
    const std::string_view kind = message.kind.substr(message.kind.rfind(' ') + 1);
    if (kind == "REQUEST") ++routing_.requests;
    if (kind == "REPLY") ++routing_.replies;
    if (kind == "ERROR") ++routing_.errors;
    if (kind == "HELLO") ++routing_.hellos;
}

/// Counts a unicast that the routing protocol passes to the MAC: a control packet, or a message.
void Metrics::count(const Routed& routed, const RecordContext& context) {
    const Message& message = context.messages[routed.frame.message];
    if (message.is_routing_packet()) return count_packet(routed.frame, message, routed.time);
    if (message.created < begin_) return;
    MessageState& state = state_of(routed.frame.message, context);
    state.waited += std::max(routed.time - state.since, Duration{0});
    state.since = routed.time;
    ++routed_.transmissions;
    if (parts_.flows && message.flow > 0) ++flow(message).routed.transmissions;
}

void Metrics::BroadcastCounts::add(NodeId sender, std::size_t existing) {
    if (existing >= by_size.size()) by_size.resize(existing + 1);
    ++by_size[existing];
    if (sender.index() >= by_sender.size()) by_sender.resize(sender.index() + 1);
    ++by_sender[sender.index()];
}

std::size_t Metrics::BroadcastCounts::robots() const {
    return std::max(by_sender.size(), by_size.empty() ? 0 : by_size.size() - 1);
}

std::vector<std::uint64_t> Metrics::BroadcastCounts::for_robots(std::size_t count) const {
    std::vector<std::uint64_t> numbers(count);
    std::uint64_t later = 0;  // number of broadcasts that were sent while robot i existed
    for (std::size_t i = count; i-- > 0;) {
        if (i + 1 < by_size.size()) later += by_size[i + 1];
        numbers[i] = later - (i < by_sender.size() ? by_sender[i] : 0);
    }
    return numbers;
}

/// Adds a message to the counts of its flow and of its destinations.
void Metrics::count_sent(const Message& message, std::uint64_t others) {
    if (parts_.flows && message.flow > 0) {
        ++flow(message).messages;
        flow(message).expected += others;
    }
    if (!parts_.robots) return;
    if (message.to == everyone) return broadcasts_.add(message.origin, others + 1);
    ++robot(message.to).messages;
    ++robot(message.to).expected;
}

/// Removes a message that was cut off from the expected deliveries.
void Metrics::count_cut_off(const Message& message, std::uint64_t others) {
    if (parts_.flows && message.flow > 0) flow(message).expected -= others;
    if (!parts_.robots) return;
    if (message.to == everyone) return cut_off_broadcasts_.add(message.origin, others + 1);
    --robot(message.to).expected;
}

void Metrics::count(const Dropped& dropped, const RecordContext& context) {
    if (dropped.protocol_decides) {
        routing_.broken += dropped.time >= begin_ && breaks_link(dropped.reason) ? 1 : 0;
        return;
    }
    if (!counts(dropped.frame, context)) return;
    ++drops_[dropped.reason];
    const Message& message = context.messages[dropped.frame.message];
    if (message.is_routed_unicast()) count_drop(reason_of(dropped.reason), message);
    if (dropped.reason != DropReason::cut_off) return;
    const MessageState& state = state_of(dropped.frame.message, context);
    ++totals_.cut_off;
    others_ -= state.others;
    reachable_ -= state.reachable.value_or(0);
    count_cut_off(message, state.others);
}

void Metrics::count(const Sent& sent, const RecordContext& context) {
    if (sent.time < begin_) return;
    ++totals_.messages;
    MessageState& state = state_of(sent.message, context);
    state.others = std::max(sent.robots, 1U) - 1;
    state.reachable = sent.reachable;
    state.shortest = sent.shortest;
    state.since = sent.time;
    if (!sent.reachable) totals_.reach_known = false;
    others_ += state.others;
    reachable_ += sent.reachable.value_or(0);
    count_sent(context.messages[sent.message], state.others);
}

void Metrics::count(const Transmitted& transmitted, const RecordContext& context) {
    const Frame& frame = transmitted.frame;
    const Message& message = context.messages[frame.message];
    if (frame.next_hop == everyone && message.is_routing_packet()) {
        count_packet(frame, message, transmitted.time);
    }
    if (!counts(frame, context)) return;
    ++totals_.transmissions;
    if (message.to != everyone || frame.sender == message.origin) return;
    auto& bits = state_of(frame.message, context).forwarders;
    const std::size_t word = frame.sender.index() / 64;
    const std::uint64_t bit = std::uint64_t{1} << (frame.sender.index() % 64);
    if (word >= bits.size()) bits.resize(std::max(word + 1, context.legs.size() / 64 + 1));
    if (!(bits[word] & bit)) ++forwarders_;
    bits[word] |= bit;
}

void Metrics::count(const Received& received, const RecordContext& context) {
    if (!counts(received.frame, context)) return;
    const Message& message = context.messages[received.frame.message];
    const bool is_routed = message.is_routed_unicast();
    const bool is_attempt = is_routed && hears_of_results(context);
    for (const Reception& rx : received.receptions) {
        if (is_attempt && !is_decoded(rx.fate)) continue;  // a drop by the protocol may follow
        ++fates_[rx.fate];
        if (is_routed) count_way(rx, received.frame, context);
        if (rx.delivered) deliver(rx, received.frame, context);
    }
}

/// Notes that a routed unicast is at a robot, or lost, and adds the way of one that is delivered.
void Metrics::count_way(const Reception& rx, const Frame& frame, const RecordContext& context) {
    const Message& message = context.messages[frame.message];
    count_drop(reason_of(rx.fate), message);
    if (rx.fate != Fate::waiting && rx.fate != Fate::arrived) return;
    MessageState& state = state_of(frame.message, context);
    state.since = rx.time;
    if (!rx.delivered) return;
    const auto add_to = [&](RoutedSums& sums) {
        ++sums.deliveries;
        sums.waited_ns += static_cast<std::uint64_t>(state.waited.count());
        sums.delay_ns += static_cast<std::uint64_t>((rx.time - message.created).count());
        if (!state.shortest) return;
        sums.hops += frame.hops;
        sums.shortest += *state.shortest;
    };
    add_to(routed_);
    if (parts_.flows && message.flow > 0) add_to(flow(message).routed);
}

/// Adds a lost copy of a routed unicast to its flow.
void Metrics::count_drop(LossReason reason, const Message& message) {
    if (!parts_.flows || message.flow == 0 || reason.code.empty()) return;
    auto& drops = flow(message).drops;
    drops.resize(loss_codes.count);
    ++drops[loss_codes.place(reason.code)];
}

void Metrics::deliver(const Reception& rx, const Frame& frame, const RecordContext& context) {
    const Message& message = context.messages[frame.message];
    const Duration delay = rx.time - message.created;
    ++totals_.deliveries;
    if (message.to == everyone) ++broadcast_deliveries_;
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
    all.resize(std::max(all.size(), broadcasts_.robots()));
    const auto sent = broadcasts_.for_robots(all.size());
    const auto cut_off = cut_off_broadcasts_.for_robots(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        all[i].messages += sent[i];
        all[i].expected += sent[i] - cut_off[i];
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
    if (routing_.packets + routed_.transmissions > 0) {
        v.routing = routing_;
        v.routed = metrics_of(routed_);
        v.routing->load = ratio(routing_.packets, v.deliveries);
        v.routing->load_bytes = ratio(routing_.bytes, bytes_);
    }
    if (parts_.robots) v.robots = robots();
    v.delivery_ratio = ratio(v.deliveries, others_);
    if (v.reach_known) v.reach = ratio(reached_, reachable_);
    // Signed numbers, because t may exceed r: robots that are not counted in r may forward.
    const auto received = static_cast<double>(broadcast_deliveries_);
    if (received > 0)
        v.saved_rebroadcasts = (received - static_cast<double>(forwarders_)) / received;
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
