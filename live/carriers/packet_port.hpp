// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace rovernet {

/// Way of packets between programs outside and this process: a UDP socket or a TAP device, say. A
/// packet is read and written as a whole, and may get lost.
class PacketPort {
  public:
    virtual ~PacketPort() = default;

    /// Where programs find it: "127.0.0.1:7100 (robot A)".
    virtual std::string text() const = 0;
    /// Descriptor at which a packet is waited for.
    virtual int descriptor() const = 0;
    /// Hands the packet that has come to `take`, if there is one.
    /// @return false if there will be none any more
    virtual bool read(const std::function<void(std::string_view packet)>& take) = 0;
    /// Sends a packet to the programs, if any are there.
    virtual void write(std::string_view packet) = 0;
};

}  // namespace rovernet
