// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/address.hpp"
#include "live/carriers/packet_port.hpp"

#include <netinet/in.h>
#include <string>

namespace rovernet {

/// UDP port of this machine. Packets go to the address that the last one came from.
class UdpPort : public PacketPort {
  public:
    /// @param own    with port 0: any that is free
    /// @param robot  whose port it is
    /// @throws RunError if it is in use
    UdpPort(const Address& own, std::string robot);
    ~UdpPort() override;
    UdpPort(const UdpPort&) = delete;
    UdpPort& operator=(const UdpPort&) = delete;

    std::string text() const override;
    int descriptor() const override { return socket_; }
    bool read(const std::function<void(std::string_view)>& take) override;
    void write(std::string_view packet) override;

  private:
    std::string robot_;
    Address where_;
    int socket_ = -1;
    sockaddr_storage peer_{};
    socklen_t peer_size_ = 0;  // 0: nobody has sent anything yet
};

}  // namespace rovernet
