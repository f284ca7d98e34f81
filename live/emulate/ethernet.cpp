// SPDX-License-Identifier: MIT
#include "live/emulate/ethernet.hpp"

#include "experiment/reports/link_table.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace rovernet {
namespace {

constexpr std::size_t address_size = 6, header_size = 14;  // [bytes]

/// Whether an address means several devices: the first bit on the wire is set (IEEE 802-2014, 8.2).
bool is_group(std::string_view address) {
    return (static_cast<std::uint8_t>(address.front()) & 1U) != 0;
}

}  // namespace

std::optional<std::string> mac_bytes(std::string_view text) {
    constexpr std::size_t text_size = 3 * address_size - 1;
    constexpr int base = 16;
    if (text.size() != text_size) return std::nullopt;
    std::string bytes;
    for (std::size_t i = 0; i < text_size; i += 3) {
        std::uint8_t byte = 0;
        const char* const end = text.data() + i + 2;
        const auto [rest, error] = std::from_chars(text.data() + i, end, byte, base);
        const bool is_separated = i + 2 == text_size || *end == ':';
        if (error != std::errc{} || rest != end || !is_separated) return std::nullopt;
        bytes += static_cast<char>(byte);
    }
    return is_group(bytes) ? std::nullopt : std::optional(bytes);
}

void EthernetFormat::begin(const Network& network) {
    for (const Device& device : devices(network)) {
        const auto address = mac_bytes(device.mac);
        if (!address) {
            throw std::invalid_argument(
                fmt::format("robot {}: found the mac \"{}\"; expected the address of a single "
                            "device, such as 02:00:00:00:00:01",
                            device.robot, device.mac));
        }
        robots_[*address] = NodeId{static_cast<std::uint32_t>(addresses_.size())};
        addresses_.push_back(*address);
    }
}

std::variant<SendCommand, PacketFault> EthernetFormat::read(NodeId from,
                                                            std::string_view frame) const {
    if (frame.size() < header_size || frame.size() > longest_message) return PacketFault::malformed;
    SendCommand send{.payload = std::string(frame),
                     .size = static_cast<std::uint32_t>(frame.size() - header_size),
                     .one_hop = true};
    const std::string_view destination = frame.substr(0, address_size);
    if (is_group(destination)) return send;
    const auto robot = robots_.find(destination);
    if (robot == robots_.end() || robot->second == from) return PacketFault::unknown_destination;
    send.to = robot->second;
    return send;
}

std::optional<std::string> EthernetFormat::write(HeardMessage heard) const {
    const std::string_view frame = heard.payload;
    if (frame.size() < header_size) return std::nullopt;
    const std::string_view destination = frame.substr(0, address_size);
    const bool is_for_it = is_group(destination) || destination == addresses_[heard.at.index()];
    if (!is_for_it) return std::nullopt;
    return std::move(heard.payload);
}

}  // namespace rovernet
