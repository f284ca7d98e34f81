// SPDX-License-Identifier: MIT
#pragma once

#include "files/part_file.hpp"
#include "sim/time.hpp"
#include "traces/recorded/bytes.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace rovernet {

/// Hardware address, the first byte first.
using MacAddress = std::array<std::uint8_t, 6>;

/// Writes a pcapng file: one section, its interfaces, then packets. Wireshark and tshark read it.
///
/// All interfaces come before the first packet. They carry 802.11 frames behind radiotap headers
/// (link type 127), with times in nanoseconds.
///
///     PcapngWriter file("run.pcapng", "rovernet 0.1.0");
///     const auto a = file.add_interface("A", {2, 0, 0, 0, 0, 1});
///     file.add_packet(a, time, PcapngWriter::Way::out, bytes);
///     file.close();
///
/// Source: draft-ietf-opsawg-pcapng, PCAP Next Generation Capture File Format, sections 4.1 to 4.3.
class PcapngWriter {
  public:
    /// Way of a packet, as its interface sees it; values of the draft's section 4.3.1.
    enum class Way : std::uint32_t { in = 1, out = 2 };

    /// Begins the file; it gets its name by close(). @throws RunError if it cannot be written, as
    /// all functions below do
    PcapngWriter(const std::string& path, std::string_view application);

    /// Adds an interface. @return its number, from 0
    std::uint32_t add_interface(std::string_view name, const MacAddress& address);
    /// Adds a packet.
    /// @param time   [ns] since the start of the run, which stands as 1970-01-01 00:00
    /// @param bytes  radiotap header and frame
    void add_packet(std::uint32_t interface, Time time, Way way, std::string_view bytes);
    /// Ends the writing, and gives the file its name.
    void close();

  private:
    // Begins a block. @return place of its length
    std::size_t begin_block(std::uint32_t type);
    // Ends the block that begin_block() began.
    void end_block(std::size_t length_at);
    void add_option(std::uint16_t code, std::string_view value);
    void end_options() { block_.fixed(std::uint32_t{0}); }
    void write_some();

    PartFile file_;
    ByteWriter block_;  // blocks that are not written yet
    std::uint32_t interfaces_ = 0;
};

}  // namespace rovernet
