// SPDX-License-Identifier: MIT
#include "traces/pcapng/wifi_packet.hpp"

#include "traces/recorded/mcap.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace rovernet {
namespace {

constexpr MacAddress network_address{2, 0, 0, 0, 0, 0};  // BSSID of all: no robot has it

/// Appends a number in network byte order.
template <class Integer>
void put_big(Integer value, ByteWriter& to) {
    for (std::size_t i = sizeof value; i-- > 0;) {
        to.fixed(static_cast<std::uint8_t>(value >> (8 * i)));
    }
}

void put_address(const MacAddress& address, ByteWriter& to) {
    to.bytes({reinterpret_cast<const char*>(address.data()), address.size()});
}

/// Level in whole dB, limited to the range of a byte.
std::uint8_t whole_db(Dbm level) {
    return static_cast<std::uint8_t>(
        static_cast<std::int8_t>(std::clamp(std::round(level.value), -128.0, 127.0)));
}

/// Duration field: reserved time in microseconds, rounded up; 802.11-2020, 9.2.5.
std::uint16_t duration_field(Duration reserved) {
    const std::int64_t us = (reserved.count() + 999) / 1000;
    return static_cast<std::uint16_t>(std::clamp<std::int64_t>(us, 0, 32'767));
}

/// Appends the frame check sequence of all bytes since `begin`.
void put_check_sequence(std::size_t begin, ByteWriter& to) {
    to.fixed(mcap_crc(to.view().substr(begin)));  // that of 802.11, too: ISO 3309
}

/// Sum of 16-bit words, ones' complement; RFC 1071.
std::uint16_t internet_checksum(std::string_view bytes) {
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
        sum += static_cast<std::uint32_t>(static_cast<std::uint8_t>(bytes[i])) << 8 |
               static_cast<std::uint8_t>(bytes[i + 1]);
    }
    while (sum >> 16) sum = (sum & 0xffff) + (sum >> 16);
    return static_cast<std::uint16_t>(~sum);
}

void append_ip(const AirFrame& air, const Message& message, const PacketAddresses& addresses,
               std::uint8_t protocol, std::size_t size, ByteWriter& to) {
    ByteWriter ip;
    ip.fixed(std::uint8_t{0x45});  // version 4, 5 words
    ip.fixed(std::uint8_t{0});
    put_big(static_cast<std::uint16_t>(20 + size), ip);
    put_big(static_cast<std::uint16_t>(message.uid), ip);
    put_big(std::uint16_t{0x4000}, ip);  // not in fragments
    ip.fixed(static_cast<std::uint8_t>(std::clamp<unsigned>(air.frame.ttl, 1, 255)));
    ip.fixed(protocol);
    const std::size_t checksum_at = ip.size();
    put_big(std::uint16_t{0}, ip);
    put_big(addresses.origin, ip);
    put_big(addresses.destination, ip);
    const std::uint16_t checksum = internet_checksum(ip.view());
    to.bytes(ip.view().substr(0, checksum_at));
    put_big(checksum, to);
    to.bytes(ip.view().substr(checksum_at + 2));
}

void append_udp(std::uint16_t port, std::string_view content, ByteWriter& to) {
    put_big(port, to);
    put_big(port, to);
    put_big(static_cast<std::uint16_t>(8 + content.size()), to);
    put_big(std::uint16_t{0}, to);  // without a checksum
    to.bytes(content);
}

void append_message(const AirFrame& air, const Message& message, std::uint32_t bytes,
                    ByteWriter& to) {
    const std::size_t carried = std::min<std::size_t>(message.size, longest_captured);
    to.bytes("rvnt");
    to.fixed(std::uint8_t{1});  // version
    to.fixed(static_cast<std::uint8_t>(message.kind.empty() ? 0 : 1));
    put_big(air.frame.ttl, to);
    put_big(air.frame.hops, to);
    put_big(std::uint16_t{0}, to);
    put_big(message.uid, to);
    put_big(message.origin.value, to);
    put_big(message.size, to);
    put_big(bytes, to);
    const std::size_t told = std::min(message.payload.size(), carried);
    to.bytes(std::string_view(message.payload).substr(0, told));
    to.bytes(std::string(carried - told, '\0'));
}

/// Appends what follows LLC and SNAP.
void append_packet(const AirFrame& air, const Message& message, std::uint32_t bytes,
                   const PacketAddresses& addresses, const PacketContent* content, ByteWriter& to) {
    if (content && content->ethertype != ipv4_ethertype) return to.bytes(content->bytes);
    ByteWriter own, behind_ip;
    if (content && content->ip_protocol != udp_protocol) behind_ip.bytes(content->bytes);
    if (!content || content->precedes_message) {
        append_message(air, message, bytes, own);
        append_udp(capture_port, own.view(), behind_ip);
    } else if (content->ip_protocol == udp_protocol) {
        append_udp(content->port, content->bytes, behind_ip);
    }
    append_ip(air, message, addresses, content ? content->ip_protocol : udp_protocol,
              behind_ip.size(), to);
    to.bytes(behind_ip.view());
}

}  // namespace

void append_radiotap(const RadiotapFacts& facts, ByteWriter& to) {
    const double rate = facts.rate.value / 500e3;
    const bool has_rate = rate == std::floor(rate) && rate >= 1 && rate <= 255;
    constexpr std::uint32_t has_flags = 1 << 1, rate_bit = 1 << 2, has_channel = 1 << 3,
                            level_bits = 1 << 5 | 1 << 6;
    to.fixed(std::uint16_t{0});   // version, and a byte that means nothing
    to.fixed(std::uint16_t{16});  // length
    to.fixed(has_flags | has_channel | (has_rate ? rate_bit : 0) | (facts.signal ? level_bits : 0));
    to.fixed(std::uint8_t{0x10});  // the check sequence is there
    to.fixed(static_cast<std::uint8_t>(has_rate ? rate : 0));
    to.fixed(static_cast<std::uint16_t>(std::clamp(facts.frequency.value / 1e6, 0.0, 65'535.0)));
    const bool is_5_ghz = facts.frequency.value > 4e9;
    to.fixed(static_cast<std::uint16_t>(is_5_ghz ? 0x0100 : 0x0080));
    to.fixed(facts.signal ? whole_db(facts.signal->level) : std::uint8_t{0});
    to.fixed(facts.signal ? whole_db(facts.signal->noise) : std::uint8_t{0});
}

void append_data_frame(const AirFrame& air, const Message& message, std::uint32_t bytes,
                       const PacketAddresses& addresses, const PacketContent* content,
                       ByteWriter& to) {
    const std::size_t begin = to.size();
    to.fixed(std::uint8_t{0x08});  // data
    to.fixed(static_cast<std::uint8_t>(air.attempt > 0 ? 0x08 : 0));
    to.fixed(duration_field(air.reserved));
    put_address(addresses.receiver, to);
    put_address(addresses.sender, to);
    put_address(network_address, to);
    to.fixed(static_cast<std::uint16_t>((air.number & 0xfff) << 4));
    to.bytes({"\xaa\xaa\x03\0\0\0", 6});  // LLC and SNAP
    put_big(content ? content->ethertype : ipv4_ethertype, to);
    append_packet(air, message, bytes, addresses, content, to);
    put_check_sequence(begin, to);
}

void append_control_frame(const AirFrame& air, const PacketAddresses& addresses, ByteWriter& to) {
    const std::size_t begin = to.size();
    constexpr std::uint8_t rts = 0xb4, cts = 0xc4, ack = 0xd4;
    to.fixed(air.is("RTS") ? rts : air.is("CTS") ? cts : ack);
    to.fixed(std::uint8_t{0});
    to.fixed(duration_field(air.reserved));
    put_address(addresses.receiver, to);
    if (air.is("RTS")) put_address(addresses.sender, to);
    put_check_sequence(begin, to);
}

}  // namespace rovernet
