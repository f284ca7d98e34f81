// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "scenario/document/value.hpp"
#include "scenario/scenario.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Description of a wireless device: addresses, frequency and mode.
struct Device {
    std::string robot, ip, mac, essid;
    Hertz frequency;
    WifiMode mode;
    bool encryption;
};

/// Link table of a robot's wireless device: neighbours whose frames the device can receive.
struct LinkTable {
    struct Row {
        Device neighbour;
        int quality;  ///< quality of the link, 0 ... 100, see link_quality()
        Dbm level;    ///< received power of the neighbour's signal at this device [dBm]
        Dbm noise;    ///< noise power at this device [dBm]
        /// Range [m] of the neighbour's propagation model, and distance [m] of the neighbour, if
        /// the model is disc, which gives no levels. None: another model.
        std::optional<Meters> range = {}, distance = {};
    };
    Device device;
    std::vector<Row> rows;  ///< one row for each neighbour, in the order of the robots
};

/// Wireless devices of all robots of a network. Missing addresses are generated: ip 10.0.0.1 and
/// mac 02:00:00:00:00:01 for the first robot, and so on. Generated addresses differ from all
/// addresses that the scenario gives.
std::vector<Device> devices(const Network& network);
/// Wireless devices of the stations of a Medium, with generated addresses where the radio has none.
/// @param names  names of the stations
std::vector<Device> devices(const Medium& medium, const std::vector<std::string>& names);
/// Wireless devices of a scenario's [[robot]]s, in the order of the robots. No network is built.
std::vector<Device> devices(const Scenario& scenario);

/// Calls visit() with the current link table of every robot, or only of `robot` if it is given.
/// Only one table is in memory at a time, with at most one row for each robot.
void for_each_link_table(const Network& network, const std::optional<std::string>& robot,
                         const std::function<void(const LinkTable&)>& visit);

/// Link table as a document: {"robot", ..., "links": [...]}.
Table link_table_document(const LinkTable& table);

}  // namespace rovernet
