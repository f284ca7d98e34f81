// SPDX-License-Identifier: MIT
#include "experiment/replay/packet_on_air.hpp"

#include "routing/aodv/aodv_packets.hpp"
#include "routing/dsr/dsr_packets.hpp"

namespace rovernet {

std::optional<PacketOnAir> packet_on_air(const Message& message, const Frame& frame,
                                         const std::function<std::uint32_t(NodeId)>& address) {
    if (message.protocol() == "AODV") {
        return PacketOnAir{.port = aodv::port,
                           .bytes = aodv::on_air(message.payload, frame, address)};
    }
    if (message.protocol() == dsr::protocol) {
        return PacketOnAir{.ip_protocol = dsr::ip_protocol,
                           .bytes = dsr::on_air(message.payload, frame, address)};
    }
    return std::nullopt;
}

std::optional<HeaderOnAir> header_on_air(const FrameHeader& header,
                                         const std::function<std::uint32_t(NodeId)>& address) {
    if (header.protocol != dsr::protocol) return std::nullopt;
    return HeaderOnAir{dsr::ip_protocol, dsr::header_on_air(header.bytes, address)};
}

}  // namespace rovernet
