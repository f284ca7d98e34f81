// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace rovernet {

/// Interface for packets between external programs and this process, such as a UDP socket or a TAP
/// device. Packets are read and written as a whole, and may be lost.
class PacketPort {
  public:
    virtual ~PacketPort() = default;

    /// Address of the port for programs: "127.0.0.1:7100 (robot A)".
    virtual std::string text() const = 0;
    /// File descriptor that becomes readable when a packet arrives.
    virtual int descriptor() const = 0;
    /// Passes the next packet to `take`, if one has arrived.
    /// @return false if no more packets can arrive
    virtual bool read(const std::function<void(std::string_view packet)>& take) = 0;
    /// Sends a packet to the programs, if any are connected.
    virtual void write(std::string_view packet) = 0;
};

}  // namespace rovernet
