// SPDX-License-Identifier: MIT
#include "traces/pcapng/pcapng_writer.hpp"

namespace rovernet {
namespace {

// Types of blocks; the first one is the same in both byte orders.
constexpr std::uint32_t section_header = 0x0A0D0D0A, interface_description = 1, enhanced_packet = 6;
constexpr std::uint32_t byte_order_magic = 0x1A2B3C4D;
constexpr std::uint16_t radiotap_link_type = 127;

enum Option : std::uint16_t {
    shb_userappl = 4,
    if_name = 2,
    if_mac_address = 6,
    if_time_resolution = 9,
    epb_flags = 2,
};

constexpr std::string_view zeros{"\0\0\0", 3};
std::string_view padding(std::size_t size) { return zeros.substr(0, (4 - size % 4) % 4); }

}  // namespace

PcapngWriter::PcapngWriter(const std::string& path, std::string_view application) : file_(path) {
    const std::size_t length_at = begin_block(section_header);
    block_.fixed(byte_order_magic);
    block_.fixed(std::uint16_t{1});  // version 1.0
    block_.fixed(std::uint16_t{0});
    block_.fixed(std::int64_t{-1});  // length of the section: not told
    add_option(shb_userappl, application);
    end_options();
    end_block(length_at);
}

std::size_t PcapngWriter::begin_block(std::uint32_t type) {
    block_.fixed(type);
    const std::size_t length_at = block_.size();
    block_.fixed(std::uint32_t{0});
    return length_at;
}

void PcapngWriter::end_block(std::size_t length_at) {
    const auto length = static_cast<std::uint32_t>(block_.size() - length_at + 8);
    block_.overwrite(length_at, length);
    block_.fixed(length);
    write_some();
}

void PcapngWriter::add_option(std::uint16_t code, std::string_view value) {
    block_.fixed(code);
    block_.fixed(static_cast<std::uint16_t>(value.size()));
    block_.bytes(value);
    block_.bytes(padding(value.size()));
}

std::uint32_t PcapngWriter::add_interface(std::string_view name, const MacAddress& address) {
    const std::size_t length_at = begin_block(interface_description);
    block_.fixed(radiotap_link_type);
    block_.fixed(std::uint16_t{0});
    block_.fixed(std::uint32_t{0});  // packets may have any length
    add_option(if_name, name);
    add_option(if_mac_address, {reinterpret_cast<const char*>(address.data()), address.size()});
    add_option(if_time_resolution, "\x09");  // 10^-9 s
    end_options();
    end_block(length_at);
    return interfaces_++;
}

void PcapngWriter::add_packet(std::uint32_t interface, Time time, Way way, std::string_view bytes) {
    const auto ns = static_cast<std::uint64_t>((time - start_of_run).count());
    const auto length = static_cast<std::uint32_t>(bytes.size());
    const std::size_t length_at = begin_block(enhanced_packet);
    block_.fixed(interface);
    block_.fixed(static_cast<std::uint32_t>(ns >> 32));
    block_.fixed(static_cast<std::uint32_t>(ns));
    block_.fixed(length);  // as captured, and as it was
    block_.fixed(length);
    block_.bytes(bytes);
    block_.bytes(padding(bytes.size()));
    ByteWriter flags;
    flags.fixed(static_cast<std::uint32_t>(way));
    add_option(epb_flags, flags.view());
    end_options();
    end_block(length_at);
}

/// Writes what has come together once it is worth a call.
void PcapngWriter::write_some() {
    constexpr std::size_t enough = 1 << 16;
    if (block_.size() < enough) return;
    file_.write(block_.view());
    block_.clear();
}

void PcapngWriter::close() {
    file_.write(block_.view());
    block_.clear();
    file_.close();
    file_.give_name();
}

}  // namespace rovernet
