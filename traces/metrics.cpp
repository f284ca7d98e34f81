// SPDX-License-Identifier: MIT
#include "traces/metrics.hpp"

#include <algorithm>

namespace rovernet {
namespace {

enum Drop : std::size_t { dup, ttl, slp, err, col, bsy, ifq, ret, end };  // as MetricValues::drops

Drop drop_of(Fate loss) {
    switch (loss) {
        case Fate::garbled: return err;
        case Fate::collided: return col;
        case Fate::busy: return bsy;
        default: return slp;
    }
}

Drop drop_of(DropReason reason) {
    switch (reason) {
        case DropReason::queue_full: return ifq;
        case DropReason::retries: return ret;
        case DropReason::end: return end;
        default: return slp;
    }
}

/// The p-th percentile by nearest rank, of n > 0 sorted delays [s].
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

Metrics::Flood& Metrics::flood(MessageId id) {
    if (id.index() >= floods_.size()) floods_.resize(id.index() + 1);
    return floods_[id.index()];
}

void Metrics::on(const Record& record, const RecordContext& context) {
    if (const auto* received = std::get_if<Received>(&record)) {
        count(*received, context);
    } else if (const auto* transmitted = std::get_if<Transmitted>(&record)) {
        count(*transmitted, context);
    } else if (const auto* sent = std::get_if<Sent>(&record)) {
        count(*sent);
    } else if (const auto* dropped = std::get_if<Dropped>(&record)) {
        count(*dropped, context);
    }
}

void Metrics::count(const Dropped& dropped, const RecordContext& context) {
    if (!counts(dropped.frame, context)) return;
    ++totals_.drops[drop_of(dropped.reason)].count;
}

void Metrics::count(const Sent& sent) {
    if (sent.time < begin_) return;
    ++totals_.messages;
    others_ += std::max(sent.robots, 1U) - 1;
    Flood& f = flood(sent.message);
    f.forwarders.clear();
    f.reachable_known = sent.reachable.has_value();
    reachable_ += sent.reachable.value_or(0);
}

void Metrics::count(const Transmitted& transmitted, const RecordContext& context) {
    const Frame& frame = transmitted.frame;
    if (!counts(frame, context)) return;
    ++totals_.transmissions;
    if (frame.sender == context.messages[frame.message].origin) return;
    auto& bits = flood(frame.message).forwarders;
    const std::size_t word = frame.sender.index() / 64;
    const std::uint64_t bit = std::uint64_t{1} << (frame.sender.index() % 64);
    if (word >= bits.size()) bits.resize(std::max(word + 1, context.legs.size() / 64 + 1));
    if (!(bits[word] & bit)) ++forwarders_;
    bits[word] |= bit;
}

void Metrics::count(const Received& received, const RecordContext& context) {
    if (!counts(received.frame, context)) return;
    for (const Reception& rx : received.receptions) {
        if (!is_decoded(rx.fate)) {
            ++totals_.drops[drop_of(rx.fate)].count;
            continue;
        }
        ++totals_.receptions;
        if (rx.fate == Fate::duplicate) ++totals_.drops[dup].count;
        if (rx.fate == Fate::ttl) ++totals_.drops[ttl].count;
        if (rx.delivered) deliver(rx, received.frame, context);
    }
}

void Metrics::deliver(const Reception& rx, const Frame& frame, const RecordContext& context) {
    ++totals_.deliveries;
    if (hops_.size() <= frame.hops) hops_.resize(frame.hops + std::size_t{1});
    ++hops_[frame.hops];
    delays_.push_back(rx.time - context.messages[frame.message].created);
    if (flood(frame.message).reachable_known) ++reached_;
}

MetricValues Metrics::values() const {
    MetricValues v = totals_;
    v.delivery_ratio = ratio(v.deliveries, others_);
    v.reach = ratio(reached_, reachable_);
    // As t may exceed r (a robot that relays from outside the count), not on unsigned numbers.
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
