// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/playing.hpp"
#include "network/network.hpp"
#include "scenario/document/value.hpp"
#include "scenario/scenario.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Description of a wireless device: addresses, frequency and mode.
struct Device {
    std::string robot, ip, mac, essid;
    Hertz frequency;
    WifiMode mode;
    bool encryption;
};

/// Link table of a robot's wireless device: the neighbours that it receives.
struct LinkTable {
    struct Row {
        Device neighbour;
        int quality;  ///< link quality 0 ... 100, see link_quality
        Dbm level;    ///< received power of the neighbour's signal at this device
        Dbm noise;    ///< power of the noise at this device
        /// Range of the neighbour's propagation model, and distance of the neighbour, if that model
        /// has no levels (disc).
        std::optional<Meters> range = {}, distance = {};
    };
    Device device;
    std::vector<Row> rows;  ///< one row for each neighbour, in the order of the robots
};

/// Wireless devices of all robots. Missing addresses are generated: ip 10.0.0.1 and mac
/// 02:00:00:00:00:01 for the first robot, and so on, skipping addresses given by the scenario.
std::vector<Device> devices(const Network& network);
/// Wireless devices of the stations of a Medium. @param names  names of the stations
std::vector<Device> devices(const Medium& medium, const std::vector<std::string>& names);
/// Devices of a scenario's robots, in their order, without building a network.
std::vector<Device> devices(const Scenario& scenario);

/// Visits the current link table of every robot, or of `robot` only, one after the other. Memory:
/// one table, with at most one row for each robot.
void for_each_link_table(const Network& network, const std::optional<std::string>& robot,
                         const std::function<void(const LinkTable&)>& visit);

/// Link table as a document: {"robot", ..., "links": [...]}.
Table link_table_document(const LinkTable& table);

/// Writes every link change of the scenario's run as CSV: time_s,from,to,event.
void write_link_history(const Scenario& scenario,
                        const std::function<void(std::string_view)>& write,
                        const TellTime& tell = {});

}  // namespace rovernet
