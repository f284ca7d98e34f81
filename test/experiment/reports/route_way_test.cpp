// SPDX-License-Identifier: MIT
#include "experiment/reports/route_way.hpp"

#include "models/propagation/disc.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <map>
#include <vector>

namespace route_way_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

using Tables = std::map<std::uint32_t, std::vector<RouteState>>;

/// A protocol with tables that are given.
struct Given {
    Tables tables;
    Hops initial_ttl() const { return 1; }
    void send(LinkLayer&, NodeId, MessageId) {}
    void on_receive(LinkLayer&, const Frame&, std::span<Reception>) {}
    std::vector<RouteState> routes(NodeId node, Time) const {
        const auto mine = tables.find(node.value);
        return mine == tables.end() ? std::vector<RouteState>{} : mine->second;
    }
};

/// Robots r0 to r4, 100 m apart, each in range of its neighbours, at 5 s.
struct Row {
    Network net{{.propagation = Disc{.range = Meters{150}}}};
    explicit Row(Tables tables, std::optional<std::uint32_t> off = {}) {
        for (int i = 0; i < 5; ++i) net.add({.name = {}, .at = {100.0 * i, 0}});
        net.route(Given{std::move(tables)});
        if (off) net.at(Time{1s}, [this, off] { net.switch_off(NodeId{*off}); });
        net.run_until(Time{5s});
    }
    RouteWay way(std::uint32_t to) const { return route_way(net, NodeId{0}, NodeId{to}); }
    std::string text(std::uint32_t to) const { return route_way_text(net, way(to)); }
};

RouteState route(std::uint32_t to, std::uint32_t next, Hops hops, Duration since = 3s) {
    return {.destination = NodeId{to},
            .next_hop = NodeId{next},
            .hops = hops,
            .since = start_of_run + since};
}

RouteState broken(RouteState route) {
    route.is_valid = false;
    return route;
}

}  // namespace

TEST_CASE("route path: each hop and its age come from the routing table of the hop's sender") {
    const Row row({{0, {route(3, 1, 3)}}, {1, {route(3, 2, 2, 1s)}}, {2, {route(3, 3, 1)}}});
    const RouteWay way = row.way(3);
    REQUIRE(way.hops.size() == 3);
    CHECK(way.hops[1].from == NodeId{1});
    CHECK(way.hops[1].to == NodeId{2});
    CHECK(way.hops[0].age == 2s);
    CHECK(way.hops[1].age == 4s);
    CHECK(way.hops[2].is_up);
    CHECK_FALSE(way.broken_at);
    CHECK(row.text(3) ==
          "route from r0 to r3: r0 > r1 > r2 > r3, 3 hops, oldest hop learnt 4 s ago");
}

TEST_CASE("route path: the path ends at a robot without a route, or with a broken route") {
    CHECK(Row({}).text(3) == "route from r0 to r3 breaks off at r0: this robot has no route to r3");
    const Row none({{0, {route(3, 1, 3)}}, {1, {route(4, 2, 3)}}});
    CHECK(none.way(3).broken_at == NodeId{1});
    CHECK(none.text(3) ==
          "route from r0 to r3 breaks off at r1: this robot has no route to r3 (r0 > r1)");
    const Row old({{0, {route(3, 1, 3)}}, {1, {broken(route(3, 2, 2))}}});
    CHECK(old.way(3).hops.size() == 1);
    CHECK(old.text(3).find("at r1: the route of this robot to r3 is broken") != std::string::npos);
    // Of several routes the shortest valid one is taken.
    const Row two({{0, {route(1, 4, 1), broken(route(2, 4, 1)), route(2, 3, 3), route(2, 1, 2)}},
                   {1, {route(2, 2, 1)}}});
    CHECK(two.text(2).find("r0 > r1 > r2, 2 hops") != std::string::npos);
}

TEST_CASE(
    "route path: the path breaks at the first hop that is not heard; later hops are still listed") {
    const Row far({{0, {route(4, 2, 2)}}, {2, {route(4, 3, 2)}}, {3, {route(4, 4, 1)}}});
    const RouteWay way = far.way(4);
    REQUIRE(way.hops.size() == 3);
    CHECK_FALSE(way.hops[0].is_up);
    CHECK(way.hops[1].is_up);
    CHECK(way.broken_at == NodeId{0});
    CHECK(way.reason == "r2 does not hear this robot");
    const Row off({{0, {route(2, 1, 2)}}, {1, {route(2, 2, 1)}}}, 1);
    CHECK(off.way(2).reason == "r1 is off");
    CHECK(off.way(2).broken_at == NodeId{0});
}

TEST_CASE("route path: a path in a routing loop ends where the loop closes") {
    const Row loop({{0, {route(4, 1, 3)}}, {1, {route(4, 2, 2)}}, {2, {route(4, 1, 3)}}});
    const RouteWay way = loop.way(4);
    CHECK(way.hops.size() == 3);
    CHECK(way.broken_at == NodeId{1});
    CHECK(way.reason == "the route leads back to this robot");
}

TEST_CASE(
    "route path: a source route is followed, whatever the routing tables of other robots contain") {
    RouteState known = route(3, 1, 3);
    known.path = {NodeId{1}, NodeId{2}, NodeId{3}};
    const Row row({{0, {known}}, {1, {route(3, 4, 9)}}});
    const RouteWay way = row.way(3);
    REQUIRE(way.hops.size() == 3);
    CHECK(way.hops[1].to == NodeId{2});
    CHECK(way.hops[2].to == NodeId{3});
    CHECK_FALSE(way.broken_at);
}

}  // namespace route_way_test
