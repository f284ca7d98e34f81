// SPDX-License-Identifier: MIT
#include "live/emulate/tap.hpp"

#include "live/emulate/namespaces.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <arpa/inet.h>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <fcntl.h>
#include <linux/if_tun.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

namespace rovernet {
namespace {

constexpr std::size_t longest_frame = 65'536;  // [bytes]

/// Network devices of the present namespace, and their settings.
class Devices {
  public:
    explicit Devices(std::string robot)
        : robot_(std::move(robot)), socket_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {}
    ~Devices() { close(socket_); }
    Devices(const Devices&) = delete;
    Devices& operator=(const Devices&) = delete;

    void set_mac(ifreq device, const std::string& mac) const {
        device.ifr_hwaddr.sa_family = ARPHRD_ETHER;
        std::memcpy(device.ifr_hwaddr.sa_data, mac.data(), mac.size());
        set(SIOCSIFHWADDR, device, "mac");
    }
    void set_ip(ifreq device, unsigned long what, const std::string& ip, const char* key) const {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        if (inet_pton(AF_INET, ip.c_str(), &address.sin_addr) != 1) {
            throw RunError(fmt::format(
                "robot {}: found the {} \"{}\"; expected four numbers as in IPv4, such as 10.0.0.1",
                robot_, key, ip));
        }
        std::memcpy(&device.ifr_addr, &address, sizeof address);
        set(what, device, key);
    }
    void switch_on(ifreq device) const {
        device.ifr_flags = IFF_UP | IFF_RUNNING;
        set(SIOCSIFFLAGS, device, "flags");
    }

  private:
    void set(unsigned long what, ifreq& device, const char* key) const {
        if (ioctl(socket_, what, &device) == 0) return;
        throw RunError(fmt::format("robot {}: cannot set the {} of {}: {}", robot_, key,
                                   device.ifr_name, std::strerror(errno)));
    }

    std::string robot_;
    int socket_;
};

ifreq named(const char* name) {
    ifreq device{};
    std::strncpy(device.ifr_name, name, IFNAMSIZ - 1);
    return device;
}

}  // namespace

int make_tap(const RobotDevice& robot) {
    constexpr const char* tun = "/dev/net/tun";
    const int descriptor = open(tun, O_RDWR | O_NONBLOCK | O_CLOEXEC);
    ifreq device = named(tap_name);
    device.ifr_flags = IFF_TAP | IFF_NO_PI;
    if (descriptor < 0 || ioctl(descriptor, TUNSETIFF, &device) != 0) {
        throw RunError(fmt::format("{}: {}; the option --udp does not need TAP devices", tun,
                                   std::strerror(errno)));
    }
    const Devices devices(robot.robot);
    devices.set_mac(device, robot.mac);
    devices.set_ip(device, SIOCSIFADDR, robot.ip, "ip");
    devices.set_ip(device, SIOCSIFNETMASK, robot.netmask, "netmask");
    devices.switch_on(device);
    devices.switch_on(named("lo"));
    return descriptor;
}

TapPort::TapPort(std::shared_ptr<Namespaces> namespaces, std::size_t robot)
    : namespaces_(std::move(namespaces)),
      robot_(robot),
      descriptor_(namespaces_->take_device(robot)) {}

TapPort::~TapPort() { close(descriptor_); }

std::string TapPort::text() const {
    const RobotDevice& device = namespaces_->robots()[robot_];
    return fmt::format("{} of robot {}, {}", tap_name, device.robot, device.ip);
}

bool TapPort::read(const std::function<void(std::string_view)>& take) {
    char bytes[longest_frame];
    const ssize_t got = ::read(descriptor_, bytes, sizeof bytes);
    if (got < 0) return errno == EAGAIN || errno == EINTR;
    take({bytes, static_cast<std::size_t>(got)});
    return true;
}

void TapPort::write(std::string_view frame) {
    (void)!::write(descriptor_, frame.data(), frame.size());
}

}  // namespace rovernet
