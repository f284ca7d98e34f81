// SPDX-License-Identifier: MIT
#pragma once

#include "live/emulate/packet_format.hpp"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Hardware address (MAC) as the bytes that stand in a frame.
/// @param text  "02:00:00:00:00:01"
/// @return 6 bytes; nothing if the text is no address of a single device
std::optional<std::string> mac_bytes(std::string_view text);

/// Ethernet frames of the robots' network devices: destination, source and type in 14 bytes, then
/// what goes on air. A frame is carried as it is, and its size on air is without these 14 bytes.
///
/// A broadcast or multicast address is everyone in range. The address of a robot is a unicast to
/// it, which the access model "csma" acknowledges and repeats. A robot gets the frames to its own
/// address, to broadcast and to multicast addresses, whoever sent them.
class EthernetFormat : public PacketFormat {
  public:
    void begin(const Network& network) override;
    std::variant<SendCommand, PacketFault> read(NodeId from, std::string_view frame) const override;
    std::optional<std::string> write(HeardMessage heard) const override;

  private:
    std::map<std::string, NodeId, std::less<>> robots_;  // by address
    std::vector<std::string> addresses_;                 // of the robots
};

}  // namespace rovernet
