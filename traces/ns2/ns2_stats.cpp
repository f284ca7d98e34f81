// SPDX-License-Identifier: MIT
#include "traces/ns2/ns2_stats.hpp"

#include "traces/metrics.hpp"
#include "traces/ns2/ns2_reader.hpp"
#include "traces/ns2/trace_counter.hpp"

#include <fmt/format.h>

#include <memory>

namespace rovernet {
namespace {

bool is_of_routing(const Ns2Packet& p) {
    return (p.ip && p.ip->from_port == routing_port) || TraceCounter::is_of_routing(p.type);
}

/// Whether a message is a unicast that a routing protocol forwards. rovernet writes its unicasts
/// over one hop with type "message" and TTL 1.
bool is_routed_unicast(const Ns2Packet& p) {
    return p.ip && p.ip->to >= 0 && !(p.type == "message" && p.ip->ttl == 1);
}

/// Counter of a trace's lines, and of the records that they form.
struct Ns2Counter {
    Metrics metrics;
    TraceCounter counter;

    KindMask kinds() const {
        return metrics.kinds() | kind_of<Sent>() | kind_of<Transmitted>() | kind_of<Received>() |
               (counter.by() == TraceRows::robot ? kind_of<Moved>() : 0);
    }
    void on(const Record& record, const RecordContext& context);
    void packet(const Ns2Packet& p, const Message* message);
};

void Ns2Counter::on(const Record& record, const RecordContext& context) {
    const auto sending = [&](MessageId id) -> TraceCounter::Sending {
        const Message& message = context.messages[id];
        return {.flow = message.flow, .size = message.size, .time = message.created};
    };
    metrics.on(record, context);
    if (const auto* s = std::get_if<Sent>(&record)) {
        counter.sent(s->node, sending(s->message));
    } else if (const auto* t = std::get_if<Transmitted>(&record)) {
        const std::uint32_t flow = context.messages[t->frame.message].flow;
        counter.transmitted(t->frame.sender, flow, t->time);
    } else if (const auto* r = std::get_if<Received>(&record)) {
        for (const Reception& rx : r->receptions) counter.received(rx, sending(r->frame.message));
    } else if (const auto* m = std::get_if<Moved>(&record)) {
        counter.know(m->node);
    }
}

void Ns2Counter::packet(const Ns2Packet& p, const Message* message) {
    counter.know(p.node);
    if (p.op == 'D') {
        counter.add_drops(p.layer, p.reason, 1);
        if (!message) return;
        counter.add_drops(p.reason, 1);
        return counter.lost(p.node, message->flow, p.time);
    }
    const bool is_sent = p.layer == "RTR" && (p.op == 's' || p.op == 'f');
    if (is_sent && !message && is_of_routing(p)) counter.routed(p.size.value_or(0));
    if (is_sent && message && is_routed_unicast(p)) counter.forwarded();
    if (counter.by() != TraceRows::flow || !message || p.layer != "AGT" || p.op != 's') return;
    counter.name_flow(message->flow, fmt::format("{} {}:{} -> {}:{}", p.type, p.ip->from,
                                                 p.ip->from_port, p.ip->to, p.ip->to_port));
}

}  // namespace

TraceStats ns2_stats(Ns2Source source, Ns2Strictness strictness, TraceRows rows) {
    const MetricParts parts{.flows = rows == TraceRows::flow};
    const auto both =
        std::make_shared<Ns2Counter>(Ns2Counter{Metrics(start_of_run, parts), TraceCounter(rows)});
    TraceStats stats;
    stats.counts = read_ns2_trace(
        std::move(source), both, strictness,
        [&](const Ns2Packet& p, const Message* message) { both->packet(p, message); });
    stats.metrics = both->metrics.values();
    const auto flows = stats.metrics.flows;
    both->counter.tell(stats, flows);
    return stats;
}

}  // namespace rovernet
