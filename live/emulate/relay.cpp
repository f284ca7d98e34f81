// SPDX-License-Identifier: MIT
#include "live/emulate/relay.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rovernet {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view from_program = "RN\x01\x00"sv;
constexpr std::string_view to_program = "RN\x01\x01"sv;
constexpr std::size_t head_size = 8;
constexpr std::int32_t unknown_level = -32'768;

std::uint32_t number_in(std::string_view bytes) {
    std::uint32_t number = 0;
    for (std::size_t i = bytes.size(); i-- > 0;) {
        number = number << 8U | static_cast<std::uint8_t>(bytes[i]);
    }
    return number;
}

void put(std::string& out, std::uint32_t number, int bytes) {
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(number >> 8 * i & 0xff);
}

/// Level in 0.1 dBm, as far as it goes into 16 bits.
std::int32_t tenths(std::optional<Dbm> level) {
    if (!level) return unknown_level;
    constexpr double most = 32'767;
    return static_cast<std::int32_t>(std::lround(std::clamp(10 * level->value, -most, most)));
}

}  // namespace

void RelayFormat::begin(const Network& network) { robots_ = network.size(); }

std::variant<SendCommand, PacketFault> RelayFormat::read(NodeId from,
                                                         std::string_view packet) const {
    if (packet.size() < head_size || !packet.starts_with(from_program)) {
        return PacketFault::malformed;
    }
    const NodeId to{number_in(packet.substr(from_program.size(), 4))};
    if (to == from || (to != everyone && to.index() >= robots_)) {
        return PacketFault::unknown_destination;
    }
    SendCommand send{.payload = std::string(packet.substr(head_size)), .one_hop = true};
    if (to != everyone) send.to = to;
    return send;
}

std::optional<std::string> RelayFormat::write(HeardMessage heard) const {
    std::string packet(to_program);
    put(packet, heard.from.value, 4);
    put(packet, static_cast<std::uint32_t>(tenths(heard.level)), 2);
    put(packet, static_cast<std::uint32_t>(heard.hops), 2);
    return packet += heard.payload;
}

}  // namespace rovernet
