// SPDX-License-Identifier: MIT
#include "sim/legs.hpp"
#include "sim/router.hpp"
#include "traces/ns2/ns2_writer.hpp"

namespace rovernet {

std::string_view ns2_type(const Message& message) {
    if (!message.kind.empty()) return message.protocol();
    return message.is_routed_unicast() ? "cbr" : "message";
}

void Ns2Trace::Writer::packet(const Ns2PacketFields& line, const RecordContext& context) {
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
void Ns2Trace::Writer::arp_packet(Ns2PacketFields line, const Message& message,
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
        text("]");
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
void Ns2Trace::Writer::describe(const Ns2PacketFields& line, const Message& message,
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
void Ns2Trace::Writer::control(const Ns2LineFields& line, const AirFrame& air, std::uint32_t bytes,
                               const RecordContext& context) {
    begin_line();
    if (format_ == Ns2Format::old_format) {
        old_start(line, 0, air.kind(), bytes + plcp_bytes);
    } else {
        new_start(line, context.legs.position(line.node, line.time));
    }
    end_line();
}

void Ns2Trace::Writer::old_start(const Ns2LineFields& line, std::uint64_t uid,
                                 std::string_view type, std::uint32_t bytes) {
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
void Ns2Trace::Writer::old_packet(const Ns2PacketFields& line, const Message& message) {
    old_start(line, message.uid, ns2_type(message), line.size(message));
    const std::string_view port = message.kind.empty() ? ":0 " : ":255 ";
    text("------- ["), integer(line.source(message).value);
    text(port), destination(message.to);
    text(port), integer(line.ttl);
    *at_++ = ' ', integer(line.next_hop(message).value_or(NodeId{0}).value);
    text("] ");
}

/// @param next_hop  -Hd; none: -2, which stands for broadcasts, too
void Ns2Trace::Writer::new_start(const Ns2LineFields& line, Vec3 position,
                                 std::optional<NodeId> next_hop) {
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

void Ns2Trace::Writer::new_packet(const Ns2PacketFields& line, const Message& message,
                                  Vec3 position) {
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

}  // namespace rovernet
