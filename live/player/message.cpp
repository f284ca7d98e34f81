// SPDX-License-Identifier: MIT
#include "live/player/message.hpp"

namespace rovernet {
namespace {

constexpr std::size_t header_size = 40;         // [bytes]
constexpr std::uint32_t own_host = 0x0100007F;  // 127.0.0.1, its bytes in the opposite order

constexpr std::uint32_t synch_end = 1, synch_overflow = 2;

/// SYNCH, which is of no port and no time.
std::string synch(std::uint32_t subtype, const std::string& payload) {
    return encode({{PlayerInterface::player, 0}, PlayerType::sync, subtype, 0, 0, payload}, 0);
}

}  // namespace

PlayerAddress read_address(XdrReader& payload) {
    payload.u32();  // host and port: a client may leave them 0
    payload.u32();
    return {static_cast<PlayerInterface>(payload.u32()), payload.u32()};
}

XdrWriter& put_address(XdrWriter& out, PlayerAddress device, std::uint16_t port) {
    out.u32(port == 0 ? 0 : own_host).u32(port);
    return out.u32(static_cast<std::uint32_t>(device.interface)).u32(device.index);
}

std::string player_banner() {
    constexpr std::size_t size = 32;  // [bytes]
    std::string banner = "Player v.3.1.0 (rovernet)";
    banner.resize(size);
    return banner;
}

std::string encode(const PlayerMessage& message, std::uint16_t port) {
    XdrWriter header;
    return put_address(header, message.device, port)
               .u32(static_cast<std::uint32_t>(message.type))
               .u32(message.subtype)
               .f64(message.time)
               .u32(message.sequence)
               .u32(static_cast<std::uint32_t>(message.payload.size()))
               .take() +
           message.payload;
}

std::string player_round_end() { return synch(synch_end, {}); }

std::string player_overflow(std::size_t lost) {
    return synch(synch_overflow, XdrWriter().u32(static_cast<std::uint32_t>(lost)).take());
}

std::optional<PlayerMessage> PlayerStream::next() {
    const std::string_view rest = std::string_view(input_).substr(taken_);
    if (rest.size() >= header_size) {
        XdrReader header(rest);
        PlayerMessage message{read_address(header), static_cast<PlayerType>(header.u32()),
                              header.u32()};
        message.time = header.f64();
        message.sequence = header.u32();
        const std::size_t size = header.u32();
        if (size > longest) throw MalformedMessage("the message is too long");
        if (rest.size() >= header_size + size) {
            message.payload = rest.substr(header_size, size);
            taken_ += header_size + size;
            return message;
        }
    }
    input_.erase(0, taken_);
    taken_ = 0;
    return std::nullopt;
}

}  // namespace rovernet
