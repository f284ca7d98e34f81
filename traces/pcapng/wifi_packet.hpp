// SPDX-License-Identifier: MIT
#pragma once

#include "sim/message.hpp"
#include "sim/units.hpp"
#include "traces/pcapng/pcapng_writer.hpp"
#include "traces/recorded/bytes.hpp"

#include <cstdint>
#include <optional>

// Bytes of a frame as a wireless card in monitor mode would capture it: a radiotap header, the
// 802.11 frame, and its check sequence.

namespace rovernet {

/// Facts of the radio that a radiotap header has.
struct RadiotapFacts {
    BitRate rate;
    /// Carrier frequency [Hz]; written in whole MHz.
    Hertz frequency;
    /// Reception: its power, and the noise of the receiver [dBm]; written in whole dB.
    struct Signal {
        Dbm level, noise;
    };
    /// Nothing in the packet of the sender.
    std::optional<Signal> signal = std::nullopt;
};
/// Appends a radiotap header of 16 bytes: flags (the check sequence is there), rate if it is a
/// multiple of 500 kb/s below 128 Mb/s, channel, level, noise.
///
/// Source: https://www.radiotap.org, fields 1, 2, 3, 5 and 6.
void append_radiotap(const RadiotapFacts& facts, ByteWriter& to);

/// Addresses of both ends of a packet.
struct PacketAddresses {
    /// Sender of the frame, and its receiver on this hop; all ones for everyone.
    MacAddress sender, receiver;
    /// Robot that made the message, and its destination; all ones for everyone.
    std::uint32_t origin = 0, destination = 0;
};
/// UDP port of both ends.
inline constexpr std::uint16_t capture_port = 49'600;
/// Size of the header before the message in a UDP packet [bytes]; docs/trace.md has its table.
inline constexpr std::size_t message_header = 32;
/// Size of the longest message that a packet takes whole [bytes]; of a longer one the begin is
/// there.
inline constexpr std::size_t longest_captured = 65'000;

/// Appends an 802.11 data frame without access point, LLC/SNAP, IPv4 and UDP, with the message in
/// it: `size` bytes, those of its payload and zeros behind them.
///
/// @param bytes  size of the frame in the run
///
/// Sources: IEEE 802.11-2020, 9.2 and 9.3.2; RFC 791; RFC 768.
void append_data_frame(const AirFrame& air, const Message& message, std::uint32_t bytes,
                       const PacketAddresses& addresses, ByteWriter& to);
/// Appends an RTS, CTS or ACK. Source: IEEE 802.11-2020, 9.3.1.
void append_control_frame(const AirFrame& air, const PacketAddresses& addresses, ByteWriter& to);

}  // namespace rovernet
