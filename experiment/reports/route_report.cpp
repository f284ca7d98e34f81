// SPDX-License-Identifier: MIT
#include "experiment/reports/route_report.hpp"

#include "files/csv_field.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>
#include <utility>

namespace rovernet {
namespace {

constexpr const char* state_of(const RouteState& route) {
    return route.is_valid ? "valid" : "broken";
}

RouteReport report_of(const Network& network, NodeId node) {
    RouteReport report{.robot = network.name(node), .now = network.now(), .rows = {}};
    for (RouteState& route : network.routes(node)) {
        RouteReport::Row row;
        row.destination = network.name(route.destination);
        if (route.next_hop != everyone) row.next_hop = network.name(route.next_hop);
        for (const NodeId each : route.path) row.path.push_back(network.name(each));
        row.route = std::move(route);
        report.rows.push_back(std::move(row));
    }
    return report;
}

/// Time of the run as decimal seconds, exact to the nanosecond.
std::string seconds_text(Duration t) {
    constexpr std::int64_t second = 1'000'000'000;
    return fmt::format("{}.{:09}", t.count() / second, t.count() % second);
}

}  // namespace

void check_has_routes(const Scenario& scenario) {
    if (scenario.routing.make().has_routes()) return;
    std::vector<std::string_view> others;
    scenario.routing.for_each([&]<class P>(const P& each, bool) {
        if (Router(each).has_routes()) others.push_back(P::name);
    });
    throw std::invalid_argument(
        fmt::format("protocol {0} keeps no routes; expected a protocol with routes ({1}), for "
                    "example by --set routing.protocol={2}",
                    scenario.routing.name(), fmt::join(others, ", "), others.front()));
}

void for_each_route_report(const Network& network, const std::optional<std::string>& robot,
                           const std::function<void(const RouteReport&)>& visit) {
    if (robot) return visit(report_of(network, robot_named(network, *robot)));
    for (std::uint32_t i = 0; i < network.size(); ++i) visit(report_of(network, NodeId{i}));
}

Table route_report_document(const RouteReport& report) {
    Array routes;
    for (const auto& [destination, next_hop, route, path] : report.rows) {
        Table row;
        row.set("destination", destination);
        row.set("next_hop", next_hop.empty() ? Value() : Value(next_hop));
        row.set("hops", std::uint64_t{route.hops});
        row.set("number", route.number ? Value(*route.number) : Value());
        row.set("state", state_of(route));
        row.set("since_s", seconds(route.since));
        row.set("age_s", seconds(report.now - route.since));
        row.set("until_s", route.until ? Value(seconds(*route.until)) : Value());
        if (!path.empty()) row.set("path", Array(path.begin(), path.end()));
        routes.emplace_back(std::move(row));
    }
    Table table;
    table.set("robot", report.robot);
    table.set("routes", std::move(routes));
    return table;
}

std::string route_report_csv(const RouteReport& report) {
    std::string lines;
    for (const auto& [destination, next_hop, route, path] : report.rows) {
        lines += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", csv_field(report.robot),
                             csv_field(destination), csv_field(next_hop), route.hops,
                             route.number ? fmt::format("{}", *route.number) : "", state_of(route),
                             seconds_text(route.since.time_since_epoch()),
                             seconds_text(report.now - route.since),
                             route.until ? seconds_text(route.until->time_since_epoch()) : "",
                             csv_field(fmt::format("{}", fmt::join(path, ">"))));
    }
    return lines;
}

}  // namespace rovernet
