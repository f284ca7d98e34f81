// SPDX-License-Identifier: MIT
#include "live/emulate/device_addresses.hpp"

#include "experiment/reports/link_table.hpp"
#include "live/emulate/ethernet.hpp"

#include <fmt/format.h>

#include <arpa/inet.h>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace rovernet {
namespace {

constexpr int ip_bits = 32;

/// Network of a host: addresses that have its first bits.
struct Network4 {
    std::uint32_t ip, mask;
    friend auto operator<=>(const Network4&, const Network4&) = default;

    std::uint32_t first() const { return ip & mask; }
    std::uint32_t last() const { return ip | ~mask; }
    int bits() const { return std::popcount(mask); }
    bool contains(std::uint32_t other) const { return (other & mask) == first(); }
};

std::optional<std::uint32_t> read_ip(const std::string& text) {
    in_addr address{};
    if (inet_pton(AF_INET, text.c_str(), &address) != 1) return std::nullopt;
    return ntohl(address.s_addr);
}

std::string ip_text(std::uint32_t ip) {
    return fmt::format("{}.{}.{}.{}", ip >> 24, ip >> 16 & 255, ip >> 8 & 255, ip & 255);
}

/// Whether an address is that of a single host which is not this machine itself: not of 0/8,
/// 127/8, multicast (224/4) or reserved (240/4).
bool is_host(std::uint32_t ip) {
    constexpr std::uint32_t own = 0, loopback = 127, first_multicast = 224;
    const std::uint32_t first = ip >> 24;
    return first != own && first != loopback && first < first_multicast;
}

/// Device of a robot, and the places of what the file says of it.
struct Addressed {
    Device device;
    const RobotTable* table;

    const RadioPlaces& places() const { return table->radio_places; }
    /// Place of a key; of the robot's radio if the file does not have that key.
    const Location& place(const Location& key) const {
        return key.source.empty() ? table->radio_where : key;
    }
    [[noreturn]] void fail(const Location& key, const std::string& message) const {
        throw InputError(place(key), fmt::format("robot {}: {}", device.robot, message));
    }
};

/// Checks one device after the other.
class DeviceAddresses {
  public:
    void add(const Addressed& each) {
        check_mac(each);
        check_ip(each);
    }
    std::vector<std::string> take_notices() {
        tell_outsiders();
        return std::move(notices_);
    }

  private:
    struct Member {
        Addressed robot;
        Network4 network;
    };

    void check_mac(const Addressed& each);
    void check_ip(const Addressed& each);
    void check_host(const Addressed& each, Network4 network);
    void tell_outsiders();

    /// Generated addresses are unique, so that a duplicate is an address in the file.
    template <class Key>
    static void check_unique(std::map<Key, const Addressed>& known, const Key& key,
                             const Addressed& each, const Location& place,
                             const std::string& what) {
        const auto [first, added] = known.emplace(key, each);
        if (added) return;
        each.fail(
            place,
            fmt::format(
                "found the {}, but robot {} has the same address; expected a different address",
                what, first->second.device.robot));
    }

    std::map<std::string, const Addressed> macs_;
    std::map<std::uint32_t, const Addressed> ips_;
    std::vector<Member> members_;
    std::vector<std::string> notices_;
    bool has_told_made_ = false;
};

void DeviceAddresses::check_mac(const Addressed& each) {
    const auto bytes = mac_bytes(each.device.mac);
    if (!bytes || *bytes == std::string(bytes->size(), '\0')) {
        each.fail(each.places().mac, fmt::format("found the mac \"{}\"; expected the address of a "
                                                 "single device, such as 02:00:00:00:00:01",
                                                 each.device.mac));
    }
    check_unique(macs_, *bytes, each, each.places().mac, "mac " + each.device.mac);
}

void DeviceAddresses::check_ip(const Addressed& each) {
    const auto ip = read_ip(each.device.ip);
    if (!ip || !is_host(*ip)) {
        each.fail(each.places().ip,
                  fmt::format("found the ip \"{}\"; expected the address of a single host of IPv4, "
                              "such as 10.0.0.1",
                              each.device.ip));
    }
    const std::string& text = each.table->radio.labels.netmask;
    const auto mask = read_ip(text);
    const bool is_mask = mask && std::countl_one(*mask) == std::popcount(*mask) && *mask != 0;
    if (!is_mask) {
        each.fail(each.places().netmask, fmt::format("found the netmask \"{}\"; expected 1 to 32 "
                                                     "bits that are 1, then only bits that are 0, "
                                                     "such as 255.255.255.0",
                                                     text));
    }
    check_unique(ips_, *ip, each, each.places().ip, "ip " + each.device.ip);
    check_host(each, {*ip, *mask});
    members_.push_back({each, {*ip, *mask}});
}

void DeviceAddresses::check_host(const Addressed& each, Network4 network) {
    if (network.bits() >= ip_bits - 1) return;
    const bool is_first = network.ip == network.first();
    if (!is_first && network.ip != network.last()) return;
    const std::string what =
        fmt::format("the ip {} is {} of the network {}/{}, not of a host", each.device.ip,
                    is_first ? "the address" : "the broadcast address", ip_text(network.first()),
                    network.bits());
    const RadioPlaces& places = each.places();
    const std::string mend =
        "expected the address of a host in this network, or a netmask with fewer bits that are 1";
    if (!places.ip.source.empty()) each.fail(places.ip, what + "; " + mend);
    if (!places.netmask.source.empty()) each.fail(places.netmask, what + "; " + mend);
    if (has_told_made_) return;
    has_told_made_ = true;
    notices_.push_back(
        fmt::format("robot {}: {}, so programs cannot reach this robot; give [radio] a netmask "
                    "with fewer bits that are 1 (a larger network), such as netmask = "
                    "\"255.255.0.0\"",
                    each.device.robot, what));
}

/// Adds a notice about the first robot whose network excludes other robots.
void DeviceAddresses::tell_outsiders() {
    std::set<std::pair<std::uint32_t, std::uint32_t>> seen;  // networks: first address, mask
    for (const Member& from : members_) {
        if (!seen.emplace(from.network.first(), from.network.mask).second) continue;
        std::vector<const Member*> outside;
        for (const Member& each : members_) {
            if (!from.network.contains(each.network.ip)) outside.push_back(&each);
        }
        if (outside.empty()) continue;
        const Addressed& one = outside.front()->robot;
        Location place = from.robot.places().ip;
        if (place.source.empty()) place = from.robot.places().netmask;
        if (place.source.empty()) place = one.places().ip;
        const std::size_t more = outside.size() - 1;
        const std::string before = place.source.empty() ? "" : place.text() + ": ";
        notices_.push_back(fmt::format(
            "{}the network {}/{} of robot {} does not contain robot {} ({}){}: packets between "
            "these robots need routes that you set (ip route)",
            before, ip_text(from.network.first()), from.network.bits(), from.robot.device.robot,
            one.device.robot, one.device.ip, more == 0 ? "" : fmt::format(", and {} more", more)));
        return;
    }
}

}  // namespace

std::vector<std::string> check_device_addresses(const Scenario& scenario) {
    DeviceAddresses addresses;
    const std::vector<Device> all = devices(scenario);
    std::size_t i = 0;
    for (const RobotTable& table : scenario.robots) {
        for (int k = 0; k < table.count.value_or(1); ++k) addresses.add({all[i++], &table});
    }
    return addresses.take_notices();
}

}  // namespace rovernet
