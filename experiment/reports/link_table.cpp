// SPDX-License-Identifier: MIT
#include "experiment/reports/link_table.hpp"

#include "experiment/reports/range_of_model.hpp"
#include "experiment/run.hpp"
#include "models/medium/medium.hpp"

#include <fmt/format.h>

#include <set>

namespace rovernet {
namespace {

std::string ip_of(std::uint32_t number) {
    return fmt::format("10.{}.{}.{}", number >> 16 & 255, number >> 8 & 255, number & 255);
}

std::string mac_of(std::uint32_t number) {
    return fmt::format("02:00:{:02x}:{:02x}:{:02x}:{:02x}", number >> 24, number >> 16 & 255,
                       number >> 8 & 255, number & 255);
}

/// Makes addresses that nobody has been given, one after the other.
class Addresses {
  public:
    using Make = std::string (*)(std::uint32_t);
    Addresses(const std::vector<const Radio*>& radios,
              std::optional<std::string> RadioLabels::*given, Make make)
        : given_(given), make_(make) {
        for (const Radio* const radio : radios) {
            if (const auto& address = radio->labels.*given)
                taken_.insert(in_small_letters(*address));
        }
    }

    std::string of(const Radio& radio, NodeId node) {
        if (const auto& address = radio.labels.*given_) return *address;
        std::string made = make_(node.value + 1);
        while (!taken_.insert(made).second) made = make_(first_spare_++);
        return made;
    }

  private:
    /// A mac is the same one in capital letters.
    static std::string in_small_letters(std::string text) {
        for (char& c : text) {
            if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
        }
        return text;
    }

    std::optional<std::string> RadioLabels::*given_;
    Make make_;
    std::set<std::string> taken_;
    std::uint32_t first_spare_ = 0x800001;  // beyond the robots' own numbers
};

Table device_document(const Device& device) {
    Table table;
    table.set("robot", device.robot);
    table.set("ip", device.ip);
    table.set("mac", device.mac);
    table.set("essid", device.essid);
    table.set("frequency_hz", device.frequency.value);
    table.set("mode", name_of(device.mode));
    table.set("encryption", device.encryption);
    return table;
}

std::vector<Device> devices(const std::vector<const Radio*>& radios,
                            const std::vector<std::string>& names) {
    Addresses ips(radios, &RadioLabels::ip, ip_of);
    Addresses macs(radios, &RadioLabels::mac, mac_of);
    std::vector<Device> all;
    for (std::uint32_t i = 0; i < names.size(); ++i) {
        const Radio& radio = *radios[i];
        all.push_back({names[i], ips.of(radio, NodeId{i}), macs.of(radio, NodeId{i}), radio.essid,
                       radio.frequency, radio.labels.mode, radio.labels.encryption});
    }
    return all;
}

}  // namespace

std::vector<Device> devices(const Medium& medium, const std::vector<std::string>& names) {
    std::vector<const Radio*> radios;
    for (std::uint32_t i = 0; i < names.size(); ++i) {
        radios.push_back(&medium.stations().radio(NodeId{i}));
    }
    return devices(radios, names);
}

std::vector<Device> devices(const Scenario& scenario) {
    std::vector<const Radio*> radios;
    std::vector<std::string> names;
    for (const RobotTable& robot : scenario.robots) {
        for (int i = 0; i < robot.count.value_or(1); ++i) {
            radios.push_back(&robot.radio);
            names.push_back(robot.name_of(i));
        }
    }
    return devices(radios, names);
}

std::vector<Device> devices(const Network& network) {
    std::vector<std::string> names;
    for (std::uint32_t i = 0; i < network.size(); ++i) names.push_back(network.name(NodeId{i}));
    return devices(network.medium(), names);
}

void for_each_link_table(const Network& network, const std::optional<std::string>& robot,
                         const std::function<void(const LinkTable&)>& visit) {
    const auto all = devices(network);
    const auto only = robot ? std::optional(robot_named(network, *robot)) : std::nullopt;
    for (std::uint32_t i = 0; i < network.size(); ++i) {
        const NodeId node{i};
        if (only && node != *only) continue;
        LinkTable table{all[i], {}};
        for (const Neighbour& n : network.links(node, network.now())) {
            LinkTable::Row& row = table.rows.emplace_back(
                LinkTable::Row{all[n.node.index()], n.quality, n.level, n.noise});
            const Stations& stations = network.medium().stations();
            row.range = range_of(stations.model(n.node));
            if (!row.range) continue;
            const auto antenna = [&](NodeId of) {
                return stations.pose(of, network.now(), network.legs()).antenna;
            };
            row.distance = Meters{distance(antenna(n.node), antenna(node))};
        }
        visit(table);
    }
}

Table link_table_document(const LinkTable& table) {
    Table robot = device_document(table.device);
    Array links;
    for (const LinkTable::Row& row : table.rows) {
        Table link = device_document(row.neighbour);
        link.set("quality", row.quality);
        link.set("level_dbm", row.range ? Value() : Value(row.level.value));
        link.set("noise_dbm", row.noise.value);
        if (row.range) {
            link.set("distance_m", row.distance->value);
            link.set("range_m", row.range->value);
        }
        links.emplace_back(std::move(link));
    }
    robot.set("links", std::move(links));
    return robot;
}

}  // namespace rovernet
