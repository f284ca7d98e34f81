// SPDX-License-Identifier: MIT
#include "traces/ns2/ns2_trace.hpp"

#include "files/part_file.hpp"
#include "sim/error.hpp"
#include "sim/legs.hpp"
#include "sim/router.hpp"
#include "traces/ns2/decimal.hpp"

#include <cmath>
#include <exception>
#include <optional>
#include <utility>
#include <variant>

namespace rovernet {
namespace {

/// Size of PLCP preamble and header at 1 Mb/s, which ns-2 includes in a frame's size.
constexpr std::uint32_t plcp_bytes = 24;
/// [bytes] that a frame with this header of the access model has on air beside its message.
constexpr std::uint32_t on_air(std::uint32_t header) { return header ? header + plcp_bytes : 0; }

/// MAC header fields of a packet; empty before a MAC has sent it.
struct MacHeader {
    std::uint32_t reserved_us = 0;
    NodeId to{0}, from{0};
    std::string_view ethertype = "0";
};

MacHeader ip_header(NodeId from, NodeId to = everyone, Duration reserved = {}) {
    constexpr std::int64_t ns_per_us = 1000;
    const auto us = (reserved.count() + ns_per_us / 2) / ns_per_us;
    return {static_cast<std::uint32_t>(us), to, from, "800"};
}

/// MAC header of a frame. CTS and ACK have no transmitter; 802.11-2020, 9.3.1.3 and 9.3.1.4.
MacHeader mac_header(const AirFrame& air) {
    MacHeader header = ip_header(air.frame.sender, air.frame.next_hop, air.reserved);
    if (!air.control) return header;
    header.ethertype = "0";
    if (air.is("CTS") || air.is("ACK")) header.from = NodeId{0};
    return header;
}

/// Common fields of all packet lines.
struct Line {
    char op;
    Time time;
    NodeId node;
    std::string_view layer;
    std::string_view reason = "---";
    MacHeader mac = {};
};

/// Fields of lines about a message's packets.
struct PacketLine : Line {
    PacketLine(Line common, MessageId id, unsigned hops) : Line(common), message(id), ttl(hops) {}
    PacketLine(Line common, const Frame& its_frame, std::uint32_t below_router = 0)
        : Line(common),
          message(its_frame.message),
          ttl(its_frame.ttl),
          added(below_router),
          frame(&its_frame) {}

    MessageId message;
    unsigned ttl;
    std::uint32_t added = 0;       ///< [bytes] by what is below the router
    const Frame* frame = nullptr;  ///< frame of the packet, if it has one yet

    std::uint32_t size(const Message& m) const {
        return (frame && frame->bytes > 0 ? frame->bytes : m.size) + added;
    }
    /// Source in the IP header: each forwarder of a protocol's broadcast writes itself.
    NodeId source(const Message& m) const {
        return frame && !m.kind.empty() && m.to == everyone ? frame->sender : m.origin;
    }
    /// Hops that the packet has made so far.
    unsigned hops() const {
        if (!frame) return 0;
        return frame->sender == node && frame->hops > 0 ? frame->hops - 1U : frame->hops;
    }
    /// Next hop, once a protocol has chosen it.
    std::optional<NodeId> next_hop(const Message& m) const {
        const bool is_chosen =
            frame && frame->next_hop != everyone && (!m.kind.empty() || m.is_routed_unicast());
        return is_chosen ? std::optional(frame->next_hop) : std::nullopt;
    }
};

}  // namespace

std::string_view ns2_type(const Message& message) {
    if (!message.kind.empty()) return message.protocol();
    return message.is_routed_unicast() ? "cbr" : "message";
}

class Ns2Trace::Writer {
  public:
    using Out = std::function<void(std::string_view)>;

    Writer(const std::string& path, Ns2Format format, MacTrace mac)
        : Writer([this](std::string_view text) { file_->write(text); }, format, mac) {
        file_.emplace(path);
    }
    Writer(Out out, Ns2Format format, MacTrace mac)
        : out_(std::move(out)),
          format_(format),
          mac_(mac),
          buffer_(std::make_unique<char[]>(size + longest_line)) {}

    void write(const Record& record, const RecordContext& context) {
        std::visit([&](const auto& r) { lines(r, context); }, record);
    }
    void finish() {
        if (std::exchange(finished_, true)) return;
        flush();
        if (file_) file_->close();
    }
    void close() {
        if (closed_) return;
        finish();
        if (file_) file_->give_name();
        closed_ = true;
    }

  private:
    static constexpr std::size_t size = 64 * 1024;
    static constexpr std::size_t longest_line = 4096;  // five doubles of longest_decimal, and room

    void lines(const Sent&, const RecordContext&);
    void lines(const Transmitted&, const RecordContext&);
    void lines(const Routed&, const RecordContext&);
    void router_line(Time, const Frame&, std::optional<NodeId> heard_from, const RecordContext&);
    void lines(const Received&, const RecordContext&);
    void lines(const Dropped&, const RecordContext&);
    void lines(const Moved&, const RecordContext&);
    void lines(const AirSent&, const RecordContext&);
    void lines(const ControlReceived&, const RecordContext&);
    template <class Other>
    void lines(const Other&, const RecordContext&) {}

    void packet(const PacketLine&, const RecordContext&);
    void arp_packet(PacketLine, const Message&, const RecordContext&);
    void describe(const PacketLine&, const Message&, const RecordContext&);
    void old_packet(const PacketLine&, const Message&);
    void new_packet(const PacketLine&, const Message&, Vec3 position);
    void control(const Line&, const AirFrame&, std::uint32_t bytes, const RecordContext&);
    void old_start(const Line&, std::uint64_t uid, std::string_view type, std::uint32_t bytes);
    void new_start(const Line&, Vec3 position, std::optional<NodeId> next_hop = {});

    // Inlined everywhere, so that a literal is a few stores: a fifth of a run's instructions.
    [[gnu::always_inline]] void text(std::string_view s) { at_ = write_text(at_, s); }
    void integer(std::uint64_t value) { at_ = write_integer(at_, value); }
    void destination(NodeId node) {
        if (node == everyone) return text("-1");
        integer(node.value);
    }
    void hex(std::uint32_t value) { at_ = write_hex(at_, value); }
    void fixed2(double value) { at_ = write_fixed2(at_, value); }
    void begin_line() { at_ = buffer_.get() + used_; }
    void end_line() {
        *at_++ = '\n';
        used_ = static_cast<std::size_t>(at_ - buffer_.get());
        if (used_ >= size) flush();
    }
    void flush() {
        const std::size_t n = std::exchange(used_, 0);
        if (n > 0) out_({buffer_.get(), n});
    }

    std::optional<PartFile> file_;
    Out out_;
    Ns2Format format_;
    MacTrace mac_;
    std::unique_ptr<char[]> buffer_;
    std::size_t used_ = 0;
    char* at_ = nullptr;  ///< where the current line goes on
    bool finished_ = false, closed_ = false;
    std::string description_;  ///< of a control packet; kept to reuse its memory
    Duration reserved_{0};     ///< by the last routed unicast that was received
};

void Ns2Trace::Writer::lines(const Sent& r, const RecordContext& context) {
    if (r.reachable) {
        begin_line();
        text("v "), at_ = write_seconds_short(at_, r.time);
        text(" eval {set sim_annotation {reachable "), integer(context.messages[r.message].uid);
        text(" "), integer(*r.reachable);
        text("}}");
        end_line();
    }
    PacketLine line{{'s', r.time, r.node, "AGT"}, r.message, r.ttl};
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
    MacHeader mac;
    if (heard_from && is_flooded) mac = ip_header(*heard_from);
    if (heard_from && !is_flooded) mac = ip_header(*heard_from, frame.sender, reserved_);
    packet({{op, time, frame.sender, "RTR", "---", mac}, frame}, context);
}

void Ns2Trace::Writer::lines(const Received& r, const RecordContext& context) {
    const Frame& frame = r.frame;
    const MacHeader mac = ip_header(frame.sender, frame.next_hop, r.reserved);
    const bool is_link_packet = context.messages[frame.message].is_link_packet();
    const bool is_unicast = context.messages[frame.message].is_routed_unicast();
    if (is_unicast) reserved_ = r.reserved;
    for (const Reception& rx : r.receptions) {
        PacketLine line{{'r', rx.time, rx.node, "MAC", "---", mac}, frame};
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
        if (!is_unicast || !rx.delivered) packet(line, context);
        if (rx.delivered) {
            line.layer = "AGT";
            packet(line, context);
        }
        if (rx.fate == Fate::waiting || rx.fate == Fate::arrived) continue;
        line.op = 'D', line.layer = reason_of(rx.fate).layer;
        line.reason = reason_of(rx.fate).code;
        packet(line, context);
    }
}

void Ns2Trace::Writer::lines(const Dropped& r, const RecordContext& context) {
    MacHeader mac;
    if (r.frame.sender != r.node) mac = ip_header(r.frame.sender, r.frame.next_hop);
    const auto [code, layer] = r.loss();
    if (layer == "MAC" && mac_ == MacTrace::off) return;
    if (layer != "MAC" && r.protocol_decides) return;  // the protocol's drop follows
    packet({{'D', r.time, r.node, layer, code, mac}, r.frame}, context);
}

void Ns2Trace::Writer::lines(const AirSent& r, const RecordContext& context) {
    const AirFrame& air = r.air;
    const Line line{'s', r.time, air.frame.sender, "MAC", "---", mac_header(air)};
    if (air.control) return control(line, air, r.bytes, context);
    packet({line, air.frame, on_air(r.header)}, context);
}

void Ns2Trace::Writer::lines(const ControlReceived& r, const RecordContext& context) {
    Line line{'r', r.reception.time, r.reception.node, "MAC", "---", mac_header(r.air)};
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

void Ns2Trace::Writer::packet(const PacketLine& line, const RecordContext& context) {
    const Message& message = context.messages[line.message];
    if (message.is_link_packet()) return arp_packet(line, message, context);
    begin_line();
    if (format_ == Ns2Format::old_format) {
        old_packet(line, message);
    } else {
        new_packet(line, message, context.legs.position(line.node, line.time));
    }
    describe(line, message, context);
    end_line();
}

/// Writes a line about an ARP packet, which has no IP header. The hardware address of a node is its
/// id; that of the asked node is 0 in a request.
void Ns2Trace::Writer::arp_packet(PacketLine line, const Message& message,
                                  const RecordContext& context) {
    const std::string_view kind = message.kind.substr(message.protocol().size() + 1);
    const bool is_request = kind == "REQUEST", is_old = format_ == Ns2Format::old_format;
    if (line.mac.ethertype == "800") line.mac.ethertype = "806";
    const NodeId from = message.origin, to = message.to, hardware = is_request ? NodeId{0} : to;
    begin_line();
    if (is_old) {
        old_start(line, message.uid, message.protocol(), line.size(message));
        text("------- ["), text(kind), text(" "), integer(from.value), text("/");
        integer(from.value), text(" "), integer(hardware.value), text("/"), integer(to.value);
        text("] ");
    } else {
        new_start(line, context.legs.position(line.node, line.time));
        text("-P arp -Po "), text(kind), text(" -Pms "), integer(from.value);
        text(" -Ps "), integer(from.value), text(" -Pmd "), integer(hardware.value);
        text(" -Pd "), integer(to.value), text(" ");
    }
    end_line();
}

/// Appends the content of the packet: what the routing protocol says of its own, and the number and
/// the hops of a routed message.
void Ns2Trace::Writer::describe(const PacketLine& line, const Message& message,
                                const RecordContext& context) {
    const bool is_old = format_ == Ns2Format::old_format;
    if (message.is_routed_unicast()) {
        text(is_old ? "[" : "-Pn cbr -Pi "), integer(message.number);
        text(is_old ? "] " : " -Pf "), integer(line.hops());
        return text(is_old ? " 0" : " -Po 0 ");
    }
    if (message.kind.empty() || !line.frame || !context.router) return;
    constexpr std::size_t longest = 2048;
    description_.clear();
    context.router->describe(message, *line.frame,
                             is_old ? PacketStyle::brackets : PacketStyle::tags, description_);
    text(std::string_view(description_).substr(0, longest));
}

/// Writes a frame without a network part.
void Ns2Trace::Writer::control(const Line& line, const AirFrame& air, std::uint32_t bytes,
                               const RecordContext& context) {
    begin_line();
    if (format_ == Ns2Format::old_format) {
        old_start(line, 0, air.kind(), bytes + plcp_bytes);
    } else {
        new_start(line, context.legs.position(line.node, line.time));
    }
    end_line();
}

void Ns2Trace::Writer::old_start(const Line& line, std::uint64_t uid, std::string_view type,
                                 std::uint32_t bytes) {
    *at_++ = line.op;
    *at_++ = ' ', at_ = write_seconds(at_, line.time);
    text(" _"), integer(line.node.value);
    text("_ "), text(line.layer);
    text("  "), text(line.reason);  // printed as %4s
    *at_++ = ' ', integer(uid);
    *at_++ = ' ', text(type);
    *at_++ = ' ', integer(bytes);
    text(" ["), hex(line.mac.reserved_us);
    *at_++ = ' ', hex(line.mac.to.value);
    *at_++ = ' ', hex(line.mac.from.value);
    *at_++ = ' ', text(line.mac.ethertype);
    text("] ");
}

// A packet of type `message` has no payload in the line, which ends with the blank before it.
void Ns2Trace::Writer::old_packet(const PacketLine& line, const Message& message) {
    old_start(line, message.uid, ns2_type(message), line.size(message));
    const std::string_view port = message.kind.empty() ? ":0 " : ":255 ";
    text("------- ["), integer(line.source(message).value);
    text(port), destination(message.to);
    text(port), integer(line.ttl);
    *at_++ = ' ', integer(line.next_hop(message).value_or(NodeId{0}).value);
    text("] ");
}

/// @param next_hop  -Hd; none: -2, which stands for broadcasts, too
void Ns2Trace::Writer::new_start(const Line& line, Vec3 position, std::optional<NodeId> next_hop) {
    *at_++ = line.op == 'D' ? 'd' : line.op;
    text(" -t "), at_ = write_seconds(at_, line.time);
    text(" -Hs "), integer(line.node.value);
    text(" -Hd "), next_hop ? integer(next_hop->value) : text("-2");
    text(" -Ni "), integer(line.node.value);
    text(" -Nx "), fixed2(position.x);
    text(" -Ny "), fixed2(position.y);
    text(" -Nz "), fixed2(position.z);
    text(" -Ne -1.000000 -Nl "), text(line.layer);
    text(" -Nw "), text(line.reason);
    text(" -Ma "), hex(line.mac.reserved_us);
    text(" -Md "), hex(line.mac.to.value);
    text(" -Ms "), hex(line.mac.from.value);
    text(" -Mt "), text(line.mac.ethertype);
    *at_++ = ' ';
}

void Ns2Trace::Writer::new_packet(const PacketLine& line, const Message& message, Vec3 position) {
    new_start(line, position, line.next_hop(message));
    const std::string_view port = message.kind.empty() ? ".0" : ".255";
    text("-Is "), integer(line.source(message).value);
    text(port), text(" -Id "), destination(message.to);
    text(port), text(" -It "), text(ns2_type(message));
    text(" -Il "), integer(line.size(message));
    text(" -If 0 -Ii "), integer(message.uid);
    text(" -Iv "), integer(line.ttl);
    *at_++ = ' ';
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
