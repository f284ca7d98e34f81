// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/packet_port.hpp"

#include <memory>
#include <string>

namespace rovernet {

class Namespaces;

/// Name of a robot's network device in its namespace.
inline constexpr const char* tap_name = "wlan0";

/// Network device of a robot, for programs in the robot's network namespace.
struct RobotDevice {
    std::string robot;
    std::string ip, netmask;  ///< IPv4 address and netmask: "10.0.0.1", "255.255.255.0"
    std::string mac;          ///< hardware address, 6 bytes
};

/// Creates a TAP device in the network namespace of this process, sets the robot's addresses, and
/// brings up the device and `lo`. The device exists as long as the descriptor is open.
/// @return descriptor for reading and writing Ethernet frames
/// @throws RunError
int make_tap(const RobotDevice& device);

/// TAP device of a robot: reads the frames that the robot's programs send, and writes the frames
/// that the robot receives.
class TapPort : public PacketPort {
  public:
    /// @param namespaces  network namespaces of all robots, with their TAP devices
    /// @param robot       index of the robot among the namespaces, from 0
    TapPort(std::shared_ptr<Namespaces> namespaces, std::size_t robot);
    ~TapPort() override;
    TapPort(const TapPort&) = delete;
    TapPort& operator=(const TapPort&) = delete;

    std::string text() const override;
    int descriptor() const override { return descriptor_; }
    bool read(const std::function<void(std::string_view)>& take) override;
    void write(std::string_view frame) override;

  private:
    std::shared_ptr<Namespaces> namespaces_;  // network namespaces of all robots
    std::size_t robot_;
    int descriptor_;
};

}  // namespace rovernet
