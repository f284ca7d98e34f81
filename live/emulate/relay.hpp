// SPDX-License-Identifier: MIT
#pragma once

#include "live/emulate/packet_format.hpp"

#include <cstdint>

namespace rovernet {

/// Datagrams of the relay, by which programs use the radio of a robot without any privilege.
/// Numbers have their lowest byte first.
///
///     from a program   52 4e 01 00 | u32 destination | payload
///     to a program     52 4e 01 01 | u32 source | i16 level | u16 hops | payload
///
/// Robots are numbered in their order in the scenario, from 0; the destination ffffffff is everyone
/// in range. The level is that of the last hop's frame, in 0.1 dBm; -32768: unknown.
///
/// The size on air is that of the payload. A program gets everything that its robot hears, the
/// messages of the scenario's own traffic among it.
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
