// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/packet_port.hpp"

#include <memory>
#include <string>

namespace rovernet {

class Namespaces;

/// Name of a robot's network device in its namespace.
inline constexpr const char* tap_name = "wlan0";

/// Network device of a robot, as its programs see it.
struct RobotDevice {
    std::string robot;
    std::string ip, netmask;  ///< "10.0.0.1", "255.255.255.0"
    std::string mac;          ///< its 6 bytes
};

/// Makes a TAP device in the network namespace of this process, with the robot's addresses, and
/// switches it and `lo` on. It is there as long as the descriptor is open.
/// @return the descriptor, at which Ethernet frames are read and written
/// @throws RunError
int make_tap(const RobotDevice& device);

/// TAP device of a robot: what its programs send is read here, and what the robot hears is written.
class TapPort : public PacketPort {
  public:
    /// @param namespaces  of which it takes the device of that number
    TapPort(std::shared_ptr<Namespaces> namespaces, std::size_t robot);
    ~TapPort() override;
    TapPort(const TapPort&) = delete;
    TapPort& operator=(const TapPort&) = delete;

    std::string text() const override;
    int descriptor() const override { return descriptor_; }
    bool read(const std::function<void(std::string_view)>& take) override;
    void write(std::string_view frame) override;

  private:
    std::shared_ptr<Namespaces> namespaces_;  // in which it lives
    std::size_t robot_;
    int descriptor_;
};

}  // namespace rovernet
