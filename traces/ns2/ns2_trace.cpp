// SPDX-License-Identifier: MIT
#include "traces/ns2/ns2_trace.hpp"

#include "sim/error.hpp"
#include "traces/ns2/ns2_writer.hpp"

#include <cmath>
#include <exception>
#include <utility>

namespace rovernet {
namespace {

/// Whether the loss ends an attempt to send the frame over the air.
constexpr bool has_been_on_air(DropReason reason) {
    return reason == DropReason::retries || reason == DropReason::unheard ||
           reason == DropReason::broken || reason == DropReason::salvaged;
}

/// [bytes] that a frame with this header of the access model has on air beside its message.
constexpr std::uint32_t on_air(std::uint32_t header) { return header ? header + plcp_bytes : 0; }

Ns2MacFields ip_header(NodeId from, NodeId to = everyone, Duration reserved = {}) {
    constexpr std::int64_t ns_per_us = 1000;
    const auto us = (reserved.count() + ns_per_us / 2) / ns_per_us;
    return {static_cast<std::uint32_t>(us), to, from, "800"};
}

/// MAC header of a frame. CTS and ACK have no transmitter; 802.11-2020, 9.3.1.3 and 9.3.1.4.
Ns2MacFields mac_header(const AirFrame& air) {
    Ns2MacFields header = ip_header(air.frame.sender, air.frame.next_hop, air.reserved);
    if (!air.control) return header;
    header.ethertype = "0";
    if (air.is("CTS") || air.is("ACK")) header.from = NodeId{0};
    return header;
}

}  // namespace

void Ns2Trace::Writer::lines(const Sent& r, const RecordContext& context) {
    if (r.reachable) {
        begin_line();
        text("v "), at_ = write_seconds_short(at_, r.time);
        text(" eval {set sim_annotation {reachable "), integer(context.messages[r.message].uid);
        text(" "), integer(*r.reachable);
        text("}}");
        end_line();
    }
    if (r.message.index() >= ttls_.size()) ttls_.resize(r.message.index() + 1);
    ttls_[r.message.index()] = r.ttl;
    Ns2PacketFields line{{'s', r.time, r.node, "AGT"}, r.message, r.ttl};
    packet(line, context);
    line.op = 'r';
    line.layer = "RTR";
    packet(line, context);
}

/// A routed unicast has one line for each hop, by its Routed, and not one for each attempt.
void Ns2Trace::Writer::lines(const Transmitted& r, const RecordContext& context) {
    const Message& message = context.messages[r.frame.message];
    if (message.is_routed && r.frame.next_hop != everyone) return;
    if (message.is_link_packet()) return;
    router_line(r.time, r.frame, r.heard_from, context);
}

void Ns2Trace::Writer::lines(const Routed& r, const RecordContext& context) {
    router_line(r.time, r.frame, r.heard_from, context);
}

void Ns2Trace::Writer::router_line(Time time, const Frame& frame, std::optional<NodeId> heard_from,
                                   const RecordContext& context) {
    const Message& message = context.messages[frame.message];
    const bool is_flooded = frame.next_hop == everyone;
    const bool is_new =
        frame.sender == message.origin || (message.to == everyone && !message.kind.empty());
    const char op = is_new ? 's' : 'f';
    Ns2MacFields mac;
    if (heard_from && is_flooded) mac = ip_header(*heard_from);
    if (heard_from && !is_flooded) mac = ip_header(*heard_from, frame.sender, reserved_);
    packet({{op, time, frame.sender, "RTR", "---", mac}, frame}, context);
}

void Ns2Trace::Writer::lines(const Received& r, const RecordContext& context) {
    const Frame& frame = r.frame;
    const Ns2MacFields mac = ip_header(frame.sender, frame.next_hop, r.reserved);
    const bool is_link_packet = context.messages[frame.message].is_link_packet();
    const bool is_unicast = context.messages[frame.message].is_routed_unicast();
    if (frame.next_hop != everyone && !is_link_packet) reserved_ = r.reserved;
    Frame handed_over = frame;  // as the application gets it: without a header of the protocol
    if (frame.header != 0) handed_over.bytes = 0;
    for (const Reception& rx : r.receptions) {
        Ns2PacketFields line{{'r', rx.time, rx.node, "MAC", "---", mac}, frame};
        const bool repeated = frame.next_hop != everyone && rx.fate == Fate::duplicate;
        if (repeated || !is_decoded(rx.fate)) {
            if (mac_ == MacTrace::off) continue;
            line.op = 'D';
            line.reason = reason_of(rx.fate).code;
            line.added = repeated ? 0 : on_air(r.header);
            packet(line, context);
            continue;
        }
        if (mac_ == MacTrace::on) packet(line, context);
        if (is_link_packet) continue;
        line.layer = "RTR";
        // A protocol with headers removes them at the destination; another one does not see the
        // packet there.
        if (!is_unicast || !rx.delivered || frame.header != 0) packet(line, context);
        if (rx.delivered) {
            line.layer = "AGT";
            line.frame = &handed_over;
            packet(line, context);
        }
        if (rx.fate == Fate::waiting || rx.fate == Fate::arrived) continue;
        line.op = 'D', line.layer = reason_of(rx.fate).layer;
        line.reason = reason_of(rx.fate).code;
        packet(line, context);
    }
}

void Ns2Trace::Writer::lines(const Dropped& r, const RecordContext& context) {
    const auto [code, layer] = r.loss();
    if (layer == "MAC" && mac_ == MacTrace::off) return;
    if (layer != "MAC" && r.protocol_decides) return;  // the protocol's drop follows
    const Frame frame = lost_frame(r, context.messages[r.frame.message]);
    const NodeId before = r.frame.sender;
    const bool is_unicast = frame.next_hop != everyone;
    Ns2MacFields mac;
    const bool is_sent_on = before != r.node && r.reason != DropReason::queue_full;
    if (is_unicast && frame.sender == r.node && (is_sent_on || has_been_on_air(r.reason))) {
        mac = ip_header(r.node, frame.next_hop, layer == "MAC" ? sent_reserved_ : reserved_);
    } else if (before != r.node) {
        mac = is_unicast ? ip_header(before, r.node, reserved_) : ip_header(before);
    }
    packet({{'D', r.time, r.node, layer, code, mac}, frame}, context);
}

/// Frame in which the node would have sent the lost copy on; the frame that it received, if it has
/// chosen no next hop.
Frame Ns2Trace::Writer::lost_frame(const Dropped& r, const Message& message) const {
    Frame frame = r.frame;
    if (r.reason == DropReason::cut_off || r.reason == DropReason::held) {
        const std::size_t place = frame.message.index();
        if (message.kind.empty() && place < ttls_.size()) frame.ttl = ttls_[place];
        frame.next_hop = everyone;
    }
    const bool has_next_hop = frame.next_hop != everyone && frame.next_hop != r.node;
    if (frame.sender == r.node || !has_next_hop || r.reason == DropReason::off) return frame;
    frame.sender = r.node;
    if (frame.ttl > 0) --frame.ttl;
    ++frame.hops;
    return frame;
}

void Ns2Trace::Writer::lines(const AirSent& r, const RecordContext& context) {
    const AirFrame& air = r.air;
    const Ns2LineFields line{'s', r.time, air.frame.sender, "MAC", "---", mac_header(air)};
    if (air.control) return control(line, air, r.bytes, context);
    if (air.frame.next_hop != everyone) sent_reserved_ = air.reserved;
    packet({line, air.frame, on_air(r.header)}, context);
}

void Ns2Trace::Writer::lines(const ControlReceived& r, const RecordContext& context) {
    Ns2LineFields line{'r', r.reception.time, r.reception.node, "MAC", "---", mac_header(r.air)};
    if (!is_decoded(r.reception.fate)) {
        line.op = 'D';
        line.reason = reason_of(r.reception.fate).code;
    }
    control(line, r.air, r.bytes, context);
}

void Ns2Trace::Writer::lines(const Moved& r, const RecordContext&) {
    const Vec3& v = r.leg.velocity;
    begin_line();
    text("M "), at_ = write_seconds5(at_, r.time);
    text(" "), integer(r.node.value);
    text(" ("), fixed2(r.leg.from.x);
    text(", "), fixed2(r.leg.from.y);
    text(", "), fixed2(r.leg.from.z);
    text("), ("), fixed2(r.leg.to.x);
    text(", "), fixed2(r.leg.to.y);
    text("), "), fixed2(std::sqrt(v.x * v.x + v.y * v.y));
    end_line();
}

Ns2Trace::Ns2Trace(const std::string& path, Ns2Format format, MacTrace mac)
    : writer_(std::make_unique<Writer>(path, format, mac)),
      mac_(mac),
      exceptions_(std::uncaught_exceptions()) {}
Ns2Trace::Ns2Trace(std::function<void(std::string_view)> out, Ns2Format format, MacTrace mac)
    : writer_(std::make_unique<Writer>(std::move(out), format, mac)),
      mac_(mac),
      exceptions_(std::uncaught_exceptions()) {}
Ns2Trace::Ns2Trace(Ns2Trace&&) noexcept = default;
Ns2Trace& Ns2Trace::operator=(Ns2Trace&&) noexcept = default;

Ns2Trace::~Ns2Trace() {
    if (!writer_ || std::uncaught_exceptions() > exceptions_) return;
    try {
        close();
    } catch (const RunError&) {
        // The file is removed; close() reports the reason.
    }
}

void Ns2Trace::on(const Record& record, const RecordContext& context) {
    writer_->write(record, context);
}
void Ns2Trace::finish() { writer_->finish(); }
void Ns2Trace::close() { writer_->close(); }

}  // namespace rovernet
