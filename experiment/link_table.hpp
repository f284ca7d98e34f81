// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/network.hpp"
#include "experiment/scenario.hpp"
#include "experiment/value.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// What a wireless device says of itself.
struct Device {
    std::string robot, ip, mac, essid;
    Hertz frequency;
    WifiMode mode;
    bool encryption;
};

/// A device's table of those that it hears.
struct LinkTable {
    struct Row {
        Device neighbour;
        int quality;  ///< 0 ... 100, see link_quality
        Dbm level;    ///< of the neighbour's signal here
        Dbm noise;    ///< here
    };
    Device device;
    std::vector<Row> rows;  ///< in the order of the robots
};

/// Every robot's device. Addresses that were not given are made: ip 10.0.0.1 for the first robot
/// and so on, mac 02:00:00:00:00:01; a number that a robot has been given is passed over.
std::vector<Device> devices(const Network& network);

/// The tables of all robots now, or of `robot` only.
std::vector<LinkTable> link_tables(const Network& network, const std::optional<std::string>& robot);

/// The same as data: {"time_s", "robots": [{"robot", ..., "links": [...]}]}.
Table link_tables_document(const std::vector<LinkTable>& tables, Time at);

/// Every link change of the scenario's run as CSV: time_s,from,to,event.
std::string link_history(const Scenario& scenario);

}  // namespace rovernet
