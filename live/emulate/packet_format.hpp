// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/session.hpp"
#include "network/network.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace rovernet {

/// Reason why a packet is rejected.
enum class PacketFault {
    malformed,            ///< the bytes are no valid packet
    unknown_destination,  ///< no other robot has the destination address
};

/// Format of the packets between a robot's programs and its radio.
class PacketFormat {
  public:
    virtual ~PacketFormat() = default;

    /// Sets the robots' addresses, before the first packet.
    /// @throws std::invalid_argument for an invalid address
    virtual void begin(const Network&) = 0;
    /// Converts a packet from a robot's programs into a message to send.
    virtual std::variant<SendCommand, PacketFault> read(NodeId from,
                                                        std::string_view packet) const = 0;
    /// Converts a received message into a packet for the robot's programs; none if the message is
    /// not for these programs.
    virtual std::optional<std::string> write(HeardMessage heard) const = 0;
};

}  // namespace rovernet
