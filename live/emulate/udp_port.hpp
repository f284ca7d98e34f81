// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/address.hpp"
#include "live/carriers/packet_port.hpp"

#include <netinet/in.h>
#include <string>

namespace rovernet {

/// UDP port of one robot. Packets are sent to the sender of the last received packet.
class UdpPort : public PacketPort {
  public:
    /// @param own    address of the port; port 0: any free port
    /// @param robot  name of the robot
    /// @throws RunError if the port is in use
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
    socklen_t peer_size_ = 0;  // 0: no packet received yet
};

}  // namespace rovernet
