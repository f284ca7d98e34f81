// SPDX-License-Identifier: MIT
#include "routing/dsr/dsr_packets.hpp"

#include "routing/big_endian.hpp"

#include <fmt/format.h>

#include <iterator>

namespace rovernet::dsr {
namespace {

using big_endian::get;
using big_endian::put;

constexpr std::uint32_t request_type = 1, reply_type = 2, error_type = 3, route_type = 96;
constexpr std::uint32_t node_unreachable = 1, no_next_header = 59, udp = 17;

/// Option in a header: its type, the place of its data, and the place behind it.
struct Option {
    std::uint32_t type;
    std::size_t data, end;
};

/// Options of a header; none if the bytes are not a header.
std::optional<std::vector<Option>> options_of(std::string_view bytes) {
    if (bytes.size() < fixed_header || get(bytes, 2, 2) != bytes.size() - fixed_header) return {};
    std::vector<Option> options;
    for (std::size_t at = fixed_header; at < bytes.size();) {
        if (at + 2 > bytes.size()) return {};
        const Option option{get(bytes, at, 1), at + 2, at + 2 + get(bytes, at + 1, 1)};
        if (option.end > bytes.size()) return {};
        options.push_back(option);
        at = option.end;
    }
    return options;
}

/// Bytes of an option before its addresses, without type and length; none for an unknown type.
std::optional<std::size_t> before_addresses(std::uint32_t type) {
    switch (type) {
        case request_type: return 2;
        case reply_type: return 1;
        case error_type: return 2;
        case route_type: return 2;
        default: return {};
    }
}

/// Appends an option up to its addresses.
void put_option(std::string& to, std::uint32_t type, std::size_t addresses, std::uint32_t fields) {
    const std::size_t before = *before_addresses(type);
    put(to, type, 1);
    put(to, static_cast<std::uint32_t>(before + 4 * addresses), 1);
    put(to, fields, before);
}
void put_nodes(std::string& to, std::span<const NodeId> nodes) {
    for (const NodeId node : nodes) put(to, node.value);
}
/// Header with these options (6.1).
std::string header_of(std::uint32_t next_header, const std::string& options) {
    std::string bytes;
    put(bytes, next_header << 24 | static_cast<std::uint32_t>(options.size()));
    return bytes + options;
}
/// Nodes between the ends of a path.
std::span<const NodeId> between(const Path& path) {
    return std::span(path.begin() + 1, path.size() - 2);
}

/// Addresses of an option; none if their number is not possible.
std::optional<Path> addresses_of(std::string_view bytes, const Option& option) {
    const std::size_t from = option.data + *before_addresses(option.type);
    if (from > option.end || (option.end - from) % 4 != 0) return {};
    const std::size_t count = (option.end - from) / 4;
    if (count > Path::longest) return {};
    Path path;
    for (std::size_t i = 0; i < count; ++i) path.add(NodeId{get(bytes, from + 4 * i)});
    return path;
}

/// Path with a node before it, and one behind it if there is one; none if it is too long.
std::optional<Path> with_ends(NodeId first, std::span<const NodeId> nodes,
                              std::optional<NodeId> last = {}) {
    if (nodes.size() + (last ? 2 : 1) > Path::longest) return {};
    Path path{first};
    for (const NodeId node : nodes) path.add(node);
    if (last) path.add(*last);
    return path;
}

/// Adds an option to a packet. @return whether it is possible
bool take(const Option& option, const Message& message, Packet& packet) {
    const std::string_view bytes = message.payload;
    if (!before_addresses(option.type)) return true;  // 8.1.6: an unknown option is skipped
    const std::optional<Path> nodes = addresses_of(bytes, option);
    if (!nodes) return false;
    if (option.type == request_type) {
        if (nodes->size() == 0) return false;
        const auto id = static_cast<std::uint16_t>(get(bytes, option.data, 2));
        const auto path = with_ends(message.origin, std::span(nodes->begin() + 1, nodes->end()));
        if (path) packet.request = {id, nodes->front(), *path};
        return path.has_value();
    }
    if (option.type == reply_type) {
        const auto path = with_ends(message.to, std::span(nodes->begin(), nodes->end()));
        if (path && path->size() > 1) packet.reply = {*path};
        return packet.reply.has_value();
    }
    if (option.type == error_type) {
        if (nodes->size() != 3 || get(bytes, option.data, 1) != node_unreachable) return false;
        const auto salvage = static_cast<std::uint8_t>(get(bytes, option.data + 1, 1) & 0xf);
        packet.error = {(*nodes)[0], (*nodes)[1], (*nodes)[2], salvage};
        return true;
    }
    packet.route = with_ends(message.origin, std::span(nodes->begin(), nodes->end()), message.to);
    return packet.route.has_value();
}

}  // namespace

std::string message_header(const Path& path, unsigned salvage, std::size_t hop) {
    const auto nodes = salvage > 0 ? std::span(path.begin(), path.hops()) : between(path);
    const auto segments_left = static_cast<std::uint32_t>(path.hops() - 1 - hop);
    std::string option;
    put_option(option, route_type, nodes.size(), salvage << 6 | segments_left);
    put_nodes(option, nodes);
    return header_of(udp, option);
}

std::string to_bytes(const Packet& packet) {
    std::string options;
    if (const auto& r = packet.request) {
        put_option(options, request_type, r->path.size(), r->id);
        put(options, r->target.value);
        put_nodes(options, std::span(r->path.begin() + 1, r->path.end()));
    }
    if (const auto& r = packet.reply) {
        put_option(options, reply_type, r->path.hops(), 0);
        put_nodes(options, std::span(r->path.begin() + 1, r->path.end()));
    }
    if (const auto& e = packet.error) {
        put_option(options, error_type, 3, node_unreachable << 8 | e->salvage);
        for (const NodeId node : {e->from, e->to, e->unreachable}) put(options, node.value);
    }
    if (const auto& path = packet.route) {
        const auto nodes = between(*path);
        const auto segments_left = static_cast<std::uint32_t>(nodes.size());
        put_option(options, route_type, nodes.size(), segments_left);
        put_nodes(options, nodes);
    }
    return header_of(no_next_header, options);
}

Packet packet_of(const Message& message) {
    const auto options = options_of(message.payload);
    if (!options) return {};
    Packet packet;
    for (const Option& each : *options) {
        if (!take(each, message, packet)) return {};
    }
    return packet;
}

std::string on_air(std::string_view bytes, const Frame& frame,
                   const std::function<std::uint32_t(NodeId)>& address) {
    std::string changed = header_on_air(bytes, address);
    const auto options = options_of(bytes);
    if (!options || frame.hops == 0) return changed;
    for (const Option& each : *options) {
        if (each.type != route_type) continue;
        char& segments_left = changed[each.data + 1];
        segments_left = static_cast<char>(get(bytes, each.data + 1, 1) + 1U - frame.hops);
    }
    return changed;
}

std::string header_on_air(std::string_view bytes,
                          const std::function<std::uint32_t(NodeId)>& address) {
    std::string changed(bytes);
    const auto options = options_of(bytes);
    if (!options) return changed;
    for (const Option& each : *options) {
        const auto before = before_addresses(each.type);
        if (!before) continue;
        for (std::size_t at = each.data + *before; at + 4 <= each.end; at += 4) {
            big_endian::set(changed, at, address(NodeId{get(bytes, at)}));
        }
    }
    return changed;
}

void describe(const Message& message, PacketStyle style, std::string& text) {
    const Packet packet = packet_of(message);
    const auto& [request, reply, error, route] = packet;
    const std::size_t addresses = request ? request->path.size() : route ? route->size() : 0;
    const NodeId none{0};
    const bool is_tags = style == PacketStyle::tags;
    fmt::format_to(
        std::back_inserter(text),
        fmt::runtime(is_tags ? "-P dsr -Ph {} -Pq {} -Ps {} -Pp {} -Pn {} -Pl {} -Pe {}->{} -Pw {} "
                               "-Pm {} -Pc {} -Pb {}->{} "
                             : "{} [{} {}] [{} {} {} {}->{}] [{} {} {} {}->{}]"),
        addresses, request ? 1 : 0, request ? request->id : 0, reply ? 1 : 0,
        request ? request->id : 0, reply ? reply->path.size() : 0,
        (reply ? reply->path.front() : none).value, (reply ? reply->path.back() : none).value,
        error ? 1 : 0, error ? 1 : 0, (error ? error->to : none).value,
        (error ? error->from : none).value, (error ? error->unreachable : none).value);
}

}  // namespace rovernet::dsr
