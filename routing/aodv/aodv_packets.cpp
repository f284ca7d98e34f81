// SPDX-License-Identifier: MIT
#include "routing/aodv/aodv_packets.hpp"

#include "routing/big_endian.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>

namespace rovernet::aodv {
namespace {

enum class Type : std::uint8_t { request = 1, reply = 2, error = 3 };

/// Writes a packet.
class Writer {
  public:
    Writer(Type type, unsigned flags, unsigned count) {
        big_endian::put(bytes_, static_cast<unsigned>(type) << 24 | flags << 16 | count);
    }
    Writer& word(std::uint32_t value) {
        big_endian::put(bytes_, value);
        return *this;
    }
    std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
};

std::uint8_t byte(std::string_view bytes, std::size_t at) {
    return static_cast<std::uint8_t>(bytes[at]);
}
std::uint32_t word(std::string_view bytes, std::size_t at) { return big_endian::get(bytes, at); }

// Flags in the second byte.
constexpr unsigned gratuitous = 0x20, destination_only = 0x10, unknown_number = 0x08,
                   repaired = 0x80;
constexpr std::size_t request_size = 24, reply_size = 20;

Request request_of(std::string_view bytes) {
    const unsigned flags = byte(bytes, 1);
    Request request{.gratuitous = (flags & gratuitous) != 0,
                    .destination_only = (flags & destination_only) != 0,
                    .id = word(bytes, 4),
                    .destination = {word(bytes, 8)},
                    .number = word(bytes, 12),
                    .originator = {word(bytes, 16)},
                    .originator_number = word(bytes, 20)};
    if ((flags & unknown_number) != 0) request.number.reset();
    return request;
}

Reply reply_of(std::string_view bytes) {
    return {.hops = byte(bytes, 3),
            .destination = {word(bytes, 4)},
            .number = word(bytes, 8),
            .originator = {word(bytes, 12)},
            .lifetime = std::chrono::milliseconds{word(bytes, 16)}};
}

Error error_of(std::string_view bytes) {
    Error error{.is_repaired = (byte(bytes, 1) & repaired) != 0, .lost = {}};
    for (std::size_t at = 4; at + 8 <= bytes.size(); at += 8) {
        error.lost.push_back({{word(bytes, at)}, word(bytes, at + 4)});
    }
    return error;
}

/// Places of the addresses in a packet.
std::vector<std::size_t> addresses_in(std::string_view bytes) {
    switch (static_cast<Type>(byte(bytes, 0))) {
        case Type::request: return {8, 16};
        case Type::reply: return {4, 12};
        case Type::error: break;
    }
    std::vector<std::size_t> places;
    for (std::size_t at = 4; at + 8 <= bytes.size(); at += 8) places.push_back(at);
    return places;
}

/// Hops before this one, which count beside those that the packet was made with.
unsigned hops_before(const Frame& frame) { return frame.hops > 0 ? frame.hops - 1U : 0U; }

}  // namespace

std::string to_bytes(const Request& r) {
    const unsigned flags = (r.gratuitous ? gratuitous : 0) |
                           (r.destination_only ? destination_only : 0) |
                           (r.number ? 0 : unknown_number);
    return Writer(Type::request, flags, 0)
        .word(r.id)
        .word(r.destination.value)
        .word(r.number.value_or(0))
        .word(r.originator.value)
        .word(r.originator_number)
        .take();
}

std::string to_bytes(const Reply& r) {
    const auto lifetime = std::chrono::floor<std::chrono::milliseconds>(r.lifetime).count();
    return Writer(Type::reply, 0, r.hops)
        .word(r.destination.value)
        .word(r.number)
        .word(r.originator.value)
        .word(static_cast<std::uint32_t>(std::clamp<std::int64_t>(lifetime, 0, 0xffffffff)))
        .take();
}

std::string to_bytes(const Error& error) {
    Writer to(Type::error, error.is_repaired ? repaired : 0,
              static_cast<unsigned>(error.lost.size()));
    for (const Error::Lost& each : error.lost) to.word(each.destination.value).word(each.number);
    return to.take();
}

Packet packet_of(std::string_view bytes) {
    if (bytes.empty()) return {};
    switch (static_cast<Type>(byte(bytes, 0))) {
        case Type::request:
            if (bytes.size() == request_size) return request_of(bytes);
            break;
        case Type::reply:
            if (bytes.size() == reply_size) return reply_of(bytes);
            break;
        case Type::error:
            if (bytes.size() >= 12 && bytes.size() == 4 + 8U * byte(bytes, 3)) {
                return error_of(bytes);
            }
            break;
    }
    return {};
}

std::string on_air(std::string_view bytes, const Frame& frame,
                   const std::function<std::uint32_t(NodeId)>& address) {
    std::string changed(bytes);
    if (packet_of(bytes).index() == 0) return changed;
    for (const std::size_t at : addresses_in(bytes)) {
        big_endian::set(changed, at, address(NodeId{word(bytes, at)}));
    }
    if (static_cast<Type>(byte(bytes, 0)) != Type::error) {
        changed[3] = static_cast<char>(byte(bytes, 3) + hops_before(frame));
    }
    return changed;
}

void describe(const Message& message, const Frame& frame, PacketStyle style, std::string& text) {
    const Packet packet = packet_of(message.payload);
    const auto write = [&](std::string_view brackets, std::string_view tags,
                           const auto&... values) {
        fmt::vformat_to(std::back_inserter(text), style == PacketStyle::tags ? tags : brackets,
                        fmt::make_format_args(values...));
    };
    // ns-2 counts the hop that a packet is about to make.
    if (const auto* asked = std::get_if<Request>(&packet)) {
        write("[0x2 {} {} [{} {}] [{} {}]] (REQUEST)",
              "-P aodv -Pt 0x2 -Ph {} -Pb {} -Pd {} -Pds {} -Ps {} -Pss {} -Pc REQUEST ",
              frame.hops, asked->id, asked->destination.value, asked->number.value_or(0),
              asked->originator.value, asked->originator_number);
    } else if (const auto* reply = std::get_if<Reply>(&packet)) {
        const bool is_hello = message.kind == hello_kind;
        write("[0x{} {} [{} {}] {:.6f}] ({})",
              "-P aodv -Pt 0x{} -Ph {} -Pd {} -Pds {} -Pl {:.6f} -Pc {} ", is_hello ? 1 : 4,
              reply->hops + frame.hops, reply->destination.value, reply->number,
              seconds(reply->lifetime), is_hello ? "HELLO" : "REPLY");
    } else if (const auto* error = std::get_if<Error>(&packet)) {
        const Error::Lost& first = error->lost.front();
        write("[0x8 {} [{} {}] {:.6f}] (ERROR)",
              "-P aodv -Pt 0x8 -Ph {} -Pd {} -Pds {} -Pl {:.6f} -Pc ERROR ", error->lost.size(),
              first.destination.value, first.number, 0.0);
    }
}

}  // namespace rovernet::aodv
