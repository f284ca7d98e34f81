// SPDX-License-Identifier: MIT
#include "experiment/reports/route_report.hpp"

#include "scenario/document/json.hpp"

#include <doctest/doctest.h>

#include <chrono>

namespace route_report_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

/// A protocol whose only robot with routes knows whole paths, and a destination without a next hop.
struct Paths {
    Hops initial_ttl() const { return 1; }
    void send(LinkLayer&, NodeId, MessageId) {}
    void on_receive(LinkLayer&, const Frame&, std::span<Reception>) {}
    std::vector<RouteState> routes(NodeId node, Time) const {
        if (node != NodeId{0}) return {};
        return {{.destination = NodeId{1}, .next_hop = everyone, .hops = 3, .is_valid = false},
                {.destination = NodeId{2},
                 .next_hop = NodeId{1},
                 .hops = 2,
                 .number = 7,
                 .since = start_of_run + 1500ms,
                 .until = start_of_run + 4s,
                 .path = {NodeId{1}, NodeId{2}}}};
    }
};

struct ThreeRobots {
    Network net{NetworkSettings{}};
    ThreeRobots() {
        for (const char* name : {"a", "b \"x\"", "c"}) net.add({.name = name, .at = {}});
        net.route(Paths{});
        net.run_until(start_of_run + 2s);
    }
};

}  // namespace

TEST_CASE(
    "routes: values that a route does not have are empty in CSV and null in JSON, and a path lists "
    "its robots by name") {
    const ThreeRobots robots;
    const Network& net = robots.net;
    std::string csv, json;
    for_each_route_report(net, {}, [&](const RouteReport& report) {
        csv += route_report_csv(report);
        json += to_json_line(route_report_document(report));
    });
    CHECK(csv ==
          "a,\"b \"\"x\"\"\",,3,,broken,0.000000000,2.000000000,,\n"
          "a,c,\"b \"\"x\"\"\",2,7,valid,1.500000000,0.500000000,4.000000000,\"b \"\"x\"\">c\"\n");
    CHECK(json.find(R"("next_hop":null)") != std::string::npos);
    CHECK(json.find(R"("until_s":null)") != std::string::npos);
    CHECK(json.find(R"("path":["b \"x\"","c"])") != std::string::npos);
    CHECK(json.find(R"({"robot":"c","routes":[]})") != std::string::npos);
}

TEST_CASE(
    "routes: a report can be limited to one robot; a robot that the network does not have is "
    "refused") {
    const ThreeRobots robots;
    const Network& net = robots.net;
    int told = 0;
    for_each_route_report(net, "c", [&](const RouteReport& report) {
        ++told;
        CHECK(report.robot == "c");
        CHECK(report.rows.empty());
    });
    CHECK(told == 1);
    CHECK_THROWS_AS(for_each_route_report(net, "d", [](const RouteReport&) {}),
                    std::invalid_argument);
}

TEST_CASE("routes: a report is refused if the routing protocol has no routing tables") {
    CHECK(Router(Paths{}).has_routes());
    Scenario scenario;
    std::size_t with = 0, without = 0;
    scenario.routing.for_each(
        [&](const auto& each, bool) { ++(Router(each).has_routes() ? with : without); });
    CHECK(with > 0);
    CHECK(without > 0);
    REQUIRE(scenario.routing.name() == "flood");
    CHECK_THROWS_AS(check_has_routes(scenario), std::invalid_argument);
    scenario.routing.model = RoutingTable::place_of<Aodv>();
    CHECK_NOTHROW(check_has_routes(scenario));
}

}  // namespace route_report_test
