// SPDX-License-Identifier: MIT
#pragma once

#include "live/emulate/packet_format.hpp"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Hardware (MAC) address, converted from text to the bytes in an Ethernet frame.
/// @param text  "02:00:00:00:00:01"
/// @return 6 bytes; none if the text is no unicast address
std::optional<std::string> mac_bytes(std::string_view text);

/// Ethernet frames of the robots' network devices: a header of 14 bytes (destination, source,
/// type), then the payload. Frames are transported unchanged; the size on air excludes the 14
/// bytes.
///
/// A frame to a broadcast or multicast address is sent to everyone in range. A frame to the address
/// of a robot is a unicast, which the access model "csma" acknowledges and retries. A robot gets
/// frames to its own address and to broadcast and multicast addresses, from any sender.
class EthernetFormat : public PacketFormat {
  public:
    void begin(const Network& network) override;
    std::variant<SendCommand, PacketFault> read(NodeId from, std::string_view frame) const override;
    std::optional<std::string> write(HeardMessage heard) const override;

  private:
    std::map<std::string, NodeId, std::less<>> robots_;  // robots by hardware address
    std::vector<std::string> addresses_;                 // hardware address of each robot
};

}  // namespace rovernet
