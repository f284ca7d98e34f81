// SPDX-License-Identifier: MIT
#include "cli/scenes/scene_commands.hpp"
#include "cli/terminal/playing.hpp"
#include "cli/terminal/text_table.hpp"
#include "experiment/reports/network_at.hpp"
#include "experiment/reports/route_report.hpp"
#include "scenario/document/json.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

namespace rovernet::cli {
namespace {

/// Next hop of a route, or all robots of its path: "n1 > n2 > n4".
std::string way_text(const RouteReport::Row& row) {
    if (!row.path.empty()) return fmt::format("{}", fmt::join(row.path, " > "));
    return row.next_hop.empty() ? "-" : row.next_hop;
}

std::string time_text(Time t) { return fmt::format("{:.3f}", seconds(t)); }

void print_text(const Network& network, const RoutesArguments& a) {
    TextTable table({"robot", "destination", "next hop", "hops", "number", "state", "since [s]",
                     "age [s]", "until [s]"});
    bool is_empty = true;
    for_each_route_report(network, a.robot, [&](const RouteReport& report) {
        for (const RouteReport::Row& row : report.rows) {
            const RouteState& r = row.route;
            table.add({report.robot, row.destination, way_text(row), fmt::format("{}", r.hops),
                       r.number ? fmt::format("{}", *r.number) : "-",
                       r.is_valid ? "valid" : "broken", time_text(r.since),
                       time_text(start_of_run + (report.now - r.since)),
                       r.until ? time_text(*r.until) : "-"});
            is_empty = false;
        }
    });
    if (is_empty) {
        fmt::print("{} no routes at {:.9g} s\n", a.robot ? *a.robot + " has" : "there are",
                   seconds(network.now()));
    } else {
        fmt::print("{}", table.text());
    }
}

void print_json(const Network& network, const RoutesArguments& a, std::string_view protocol) {
    fmt::print("{{\n  \"time_s\": {},\n  \"protocol\": {},\n  \"robots\": [",
               to_json_line(seconds(network.now())), to_json_line(protocol));
    const char* between = "\n";
    for_each_route_report(network, a.robot, [&](const RouteReport& report) {
        fmt::print("{}{}", std::exchange(between, ",\n"),
                   to_json_line(route_report_document(report)));
    });
    fmt::print("\n  ]\n}}\n");
}

}  // namespace

void routes(const RoutesArguments& a) {
    const Scenario scenario = scenario_of(a);
    const Time at = time_within(scenario, a.at);
    check_has_routes(scenario);
    const auto network = [&] {
        Playing playing(a.file, at);
        return network_with_traffic_at(scenario, at, playing.tell());
    }();
    if (a.robot) (void)robot_named(*network, *a.robot);
    if (a.json) return print_json(*network, a, scenario.routing.name());
    if (!a.csv) return print_text(*network, a);
    fmt::print("{}", route_report_csv_head);
    for_each_route_report(*network, a.robot, [](const RouteReport& report) {
        fmt::print("{}", route_report_csv(report));
    });
}

}  // namespace rovernet::cli
