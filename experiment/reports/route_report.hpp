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

/// Routing table of a robot, with the names of the robots in it.
struct RouteReport {
    struct Row {
        std::string destination;
        std::string next_hop;  ///< name of the next hop; empty if the route has none
        RouteState route;
        std::vector<std::string> path;  ///< names of the robots in RouteState::path
    };
    std::string robot;
    Time now;               ///< simulated time of the table
    std::vector<Row> rows;  ///< one row for each route, in the order of the destinations
};

/// Checks that the routing protocol of the scenario has routing tables.
/// @throws std::invalid_argument that names the protocols with routing tables
void check_has_routes(const Scenario& scenario);

/// Calls visit() with the current routing table of every robot, or only of `robot` if it is given,
/// in the order of the robots. Only one table is in memory at a time.
/// @throws std::invalid_argument for an unknown robot
void for_each_route_report(const Network& network, const std::optional<std::string>& robot,
                           const std::function<void(const RouteReport&)>& visit);

/// Routing table as a document: {"robot", "routes": [...]}.
Table route_report_document(const RouteReport& report);

/// Header line of the CSV output, for the lines of route_report_csv().
inline constexpr const char* route_report_csv_head =
    "robot,destination,next_hop,hops,number,state,since_s,age_s,until_s,path\n";
/// Routing table as CSV lines, one for each route. A field is empty if its value is unknown. The
/// robots of a path have a '>' between them.
std::string route_report_csv(const RouteReport& report);

}  // namespace rovernet
