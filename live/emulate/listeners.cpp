// SPDX-License-Identifier: MIT
#include "live/emulate/listeners.hpp"

#include "experiment/reports/link_table.hpp"
#include "live/emulate/ethernet.hpp"
#include "live/emulate/namespaces.hpp"
#include "live/emulate/packet_front.hpp"
#include "live/emulate/relay.hpp"
#include "live/emulate/udp_port.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace rovernet {
namespace {

template <class Format>
std::unique_ptr<Front> packet_front(Front::Carrier carrier) {
    return std::make_unique<PacketFront>(std::make_unique<Format>(), std::move(carrier));
}

FrontListeners::Ports udp_ports(Address own, const Network& network) {
    check_udp_ports(own, network.size());
    FrontListeners::Ports ports;
    for (NodeId n{0}; n.index() < network.size(); ++n.value) {
        ports.push_back(std::make_unique<UdpPort>(own, network.name(n)));
        if (own.port != 0) ++own.port;
    }
    return ports;
}

FrontListeners::Ports tap_ports(const Network& network, const std::string& folder,
                                const std::function<bool()>& go_on) {
    std::vector<RobotDevice> robots;
    for (const Device& device : devices(network)) {
        const NodeId robot{static_cast<std::uint32_t>(robots.size())};
        robots.push_back({.robot = device.robot,
                          .ip = device.ip,
                          .netmask = network.robot(robot).radio.labels.netmask,
                          .mac = mac_bytes(device.mac).value()});
    }
    const auto namespaces = std::make_shared<Namespaces>(std::move(robots), folder, go_on);
    FrontListeners::Ports ports;
    for (std::size_t i = 0; i < namespaces->robots().size(); ++i) {
        ports.push_back(std::make_unique<TapPort>(namespaces, i));
    }
    return ports;
}

}  // namespace

FrontListeners tap_devices(const std::string& folder, std::function<bool()> go_on) {
    return {.entries = {},
            .make = packet_front<EthernetFormat>,
            .open_ports = [folder, go_on = std::move(go_on)](const Network& network) {
                return tap_ports(network, folder, go_on);
            }};
}

void check_udp_ports(const Address& first, std::size_t robots) {
    constexpr std::size_t after_last = 65'536;
    if (first.port == 0 || robots <= after_last - first.port) return;
    throw std::invalid_argument(
        fmt::format("{}: found {} robots, each of which needs its own port, from port {} on; "
                    "expected {} robots at most",
                    first.text(), robots, first.port, after_last - first.port));
}

FrontListeners udp_relay(const Address& first) {
    return {.entries = {},
            .make = packet_front<RelayFormat>,
            .open_ports = [first](const Network& network) { return udp_ports(first, network); }};
}

}  // namespace rovernet
