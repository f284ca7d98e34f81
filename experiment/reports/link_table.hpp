// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/playing.hpp"
#include "network/network.hpp"
#include "scenario/scenario.hpp"
#include "scenario/document/value.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Description of a wireless device, as it says it of itself.
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
        Dbm level;    ///< received power of the neighbour's signal here
        Dbm noise;    ///< here
    };
    Device device;
    std::vector<Row> rows;  ///< rows in the order of the robots
};

/// Devices of all robots. Addresses that were not given are made: ip 10.0.0.1 for the first robot
/// and so on, mac 02:00:00:00:00:01; a number that a robot has been given is passed over.
std::vector<Device> devices(const Network& network);
/// Devices of the stations of a medium, which have these names.
std::vector<Device> devices(const Medium& medium, const std::vector<std::string>& names);
/// Devices of the robots that a scenario makes, in their order, before it makes them.
std::vector<Device> devices(const Scenario& scenario);

/// Visits the tables of all robots now, or of `robot` only, one after the other: the memory is that
/// of one table, n rows for n robots.
void for_each_link_table(const Network& network, const std::optional<std::string>& robot,
                         const std::function<void(const LinkTable&)>& visit);

/// A table as data: {"robot", ..., "links": [...]}.
Table link_table_document(const LinkTable& table);

/// Writes every link change of the scenario's run as CSV: time_s,from,to,event.
void write_link_history(const Scenario& scenario,
                        const std::function<void(std::string_view)>& write,
                        const TellTime& tell = {});

}  // namespace rovernet
