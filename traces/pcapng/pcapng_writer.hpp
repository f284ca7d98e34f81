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

/// Hardware (MAC) address, first byte first.
using MacAddress = std::array<std::uint8_t, 6>;

/// Writer of pcapng files: one section, its interfaces, then packets. Wireshark and tshark read
/// them.
///
/// All interfaces are added before the first packet. Packets are 802.11 frames with radiotap
/// headers (link type 127), with times in nanoseconds.
///
///     PcapngWriter file("run.pcapng", "rovernet 0.1.0");
///     const auto a = file.add_interface("A", {2, 0, 0, 0, 0, 1});
///     file.add_packet(a, time, PcapngWriter::Way::out, bytes);
///     file.close();
///
/// Source: draft-ietf-opsawg-pcapng, PCAP Next Generation Capture File Format, sections 4.1 to 4.3.
class PcapngWriter {
  public:
    /// Direction of a packet at its interface; values of the draft's section 4.3.1.
    enum class Way : std::uint32_t { in = 1, out = 2 };

    /// Opens the file under the temporary name NAME.N.part, see PartFile. close() renames it.
    /// @throws RunError if it cannot be written, like all functions below
    PcapngWriter(const std::string& path, std::string_view application);

    /// Adds an interface. @return number of the interface, from 0
    std::uint32_t add_interface(std::string_view name, const MacAddress& address);
    /// Adds a packet.
    /// @param time   [ns] since the start of the run, which counts as 1970-01-01 00:00
    /// @param bytes  radiotap header and frame
    void add_packet(std::uint32_t interface, Time time, Way way, std::string_view bytes);
    /// Writes the rest of the file, then renames it from NAME.N.part to NAME.
    void close();

  private:
    // Begins a block. @return position of its length field
    std::size_t begin_block(std::uint32_t type);
    // Ends the block that begin_block() began.
    void end_block(std::size_t length_at);
    void add_option(std::uint16_t code, std::string_view value);
    void end_options() { block_.fixed(std::uint32_t{0}); }
    void write_some();

    PartFile file_;
    ByteWriter block_;  // blocks not written yet
    std::uint32_t interfaces_ = 0;
};

}  // namespace rovernet
