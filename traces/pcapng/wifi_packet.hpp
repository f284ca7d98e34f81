// SPDX-License-Identifier: MIT
#pragma once

#include "sim/message.hpp"
#include "sim/units.hpp"
#include "traces/pcapng/pcapng_writer.hpp"
#include "traces/recorded/bytes.hpp"

#include <cstdint>
#include <optional>
#include <string>

// Bytes of a frame as captured by a wireless card in monitor mode: a radiotap header, the 802.11
// frame, and its frame check sequence.

namespace rovernet {

/// Radio data of a captured frame, for its radiotap header.
struct RadiotapFacts {
    BitRate rate;
    /// Carrier frequency [Hz]; written in whole MHz.
    Hertz frequency;
    /// Reception: received power and noise of the receiver [dBm]; written in whole dB.
    struct Signal {
        Dbm level, noise;
    };
    /// Received power and noise; empty in the packet that the sender captures.
    std::optional<Signal> signal = std::nullopt;
};
/// Appends a radiotap header of 16 bytes: flags (frame check sequence present), rate if it is a
/// multiple of 500 kb/s below 128 Mb/s, channel, level, noise.
///
/// Source: https://www.radiotap.org, fields 1, 2, 3, 5 and 6.
void append_radiotap(const RadiotapFacts& facts, ByteWriter& to);

/// Addresses in a captured packet.
struct PacketAddresses {
    /// Sender and receiver of the frame on this hop; all ones for everyone.
    MacAddress sender, receiver;
    /// Origin and destination of the message; all ones for everyone.
    std::uint32_t origin = 0, destination = 0;
};
/// Protocol number of UDP in IP headers.
inline constexpr std::uint8_t udp_protocol = 17;
/// EtherType of IPv4, in the SNAP header.
inline constexpr std::uint16_t ipv4_ethertype = 0x0800;
/// Bytes that a captured packet has instead of the message, or before it: an ARP packet, a control
/// packet of a routing protocol, or a header.
struct PacketContent {
    /// EtherType in the SNAP header. If it is not IPv4, `bytes` follow the SNAP header directly.
    std::uint16_t ethertype = ipv4_ethertype;
    std::uint8_t ip_protocol = udp_protocol;
    /// UDP port of source and destination; not used if `ip_protocol` is not UDP.
    std::uint16_t port = 0;
    std::string bytes;
    /// True: `bytes` are a header between the IP and the UDP header, and the message follows.
    bool precedes_message = false;
};
/// UDP port of source and destination in captured packets.
inline constexpr std::uint16_t capture_port = 49'600;
/// Size of the header before the message in a UDP packet [bytes]; docs/formats/capture.md has its
/// layout.
inline constexpr std::size_t message_header = 32;
/// Size of the longest message that a packet can contain completely [bytes]; a longer one is
/// truncated.
inline constexpr std::size_t longest_captured = 65'000;

/// Appends an 802.11 data frame (ad hoc mode) that contains the message in a UDP packet: headers of
/// 802.11, LLC/SNAP, IPv4 and UDP, the header of message_header bytes, then Message::size bytes:
/// the payload, padded with zeros. There is no UDP header if `content` has another IP protocol, and
/// no IP header if it has another EtherType.
///
/// @param bytes    size of the frame in the simulation [bytes], stored in the message header
/// @param content  bytes that replace message header and message, or precede them; null: no such
///                 bytes
///
/// Sources: IEEE 802.11-2020, 9.2 and 9.3.2; RFC 1042 (SNAP); RFC 791; RFC 768.
void append_data_frame(const AirFrame& air, const Message& message, std::uint32_t bytes,
                       const PacketAddresses& addresses, const PacketContent* content,
                       ByteWriter& to);
/// Appends an 802.11 control frame: RTS, CTS or ACK. Source: IEEE 802.11-2020, 9.3.1.
void append_control_frame(const AirFrame& air, const PacketAddresses& addresses, ByteWriter& to);

}  // namespace rovernet
