// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/session.hpp"
#include "network/network.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace rovernet {

/// Reason why a packet is not sent.
enum class PacketFault {
    malformed,            ///< its bytes make no sense
    unknown_destination,  ///< no other robot has that address
};

/// Format of the packets between a robot's programs and its radio.
class PacketFormat {
  public:
    virtual ~PacketFormat() = default;

    /// Learns the robots' addresses, before any packet.
    /// @throws std::invalid_argument for one that is none
    virtual void begin(const Network&) = 0;
    /// Message that a packet from a robot's programs asks for.
    virtual std::variant<SendCommand, PacketFault> read(NodeId from,
                                                        std::string_view packet) const = 0;
    /// Packet in which a robot's programs get what it heard; nothing if it is not for them.
    virtual std::optional<std::string> write(HeardMessage heard) const = 0;
};

}  // namespace rovernet
