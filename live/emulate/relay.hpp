// SPDX-License-Identifier: MIT
#pragma once

#include "live/emulate/packet_format.hpp"

namespace rovernet {

/// Datagram format by which programs use the radio of a robot without privileges. Numbers are
/// little-endian.
///
///     from a program   52 4e 01 00 | u32 destination | payload
///     to a program     52 4e 01 01 | u32 source | i16 level | u16 hops | payload
///
/// Robots are numbered in their order in the scenario, from 0; the destination ffffffff is everyone
/// in range. The level is the received level of the last hop's frame, in 0.1 dBm; -32768: unknown.
///
/// The size on air is the size of the payload. A program gets every message that its robot
/// receives, including messages of the scenario's traffic.
class RelayFormat : public PacketFormat {
  public:
    void begin(const Network& network) override;
    std::variant<SendCommand, PacketFault> read(NodeId from,
                                                std::string_view packet) const override;
    std::optional<std::string> write(HeardMessage heard) const override;

  private:
    std::size_t robots_ = 0;
};

}  // namespace rovernet
