// SPDX-License-Identifier: MIT
#include "models/access/list.hpp"
#include "models/propagation/disc.hpp"
#include "models/reception/list.hpp"
#include "network/network.hpp"
#include "routing/aodv.hpp"
#include "routing/dsr.hpp"
#include "routing/flood.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace run_end_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

std::uint64_t dropped(const MetricValues& values, std::string_view code) {
    const auto found = std::find_if(values.drops.begin(), values.drops.end(),
                                    [&](const DropCount& d) { return d.reason == code; });
    REQUIRE(found != values.drops.end());
    return found->count;
}

/// Robots on a line, 10 m apart, of which each hears the next.
struct Line : Network {
    explicit Line(int robots, NetworkSettings settings = {}) : Network(of(std::move(settings))) {
        route(Flood{});
        for (int i = 0; i < robots; ++i) add({.name = "", .at = {10.0 * i, 0, 0}});
    }
    static NetworkSettings of(NetworkSettings settings) {
        settings.propagation = Disc{.range = {11}};
        return settings;
    }
};

constexpr NodeId a{0}, b{1}, c{2};

/// Sink that keeps the robots at which messages were dropped.
struct Losers {
    std::vector<NodeId> robots = {};
    KindMask kinds() const { return kind_of<Dropped>(); }
    void on(const Record& record, const RecordContext&) {
        robots.push_back(std::get<Dropped>(record).node);
    }
};

}  // namespace

TEST_CASE(
    "end of the run: a message that nobody has received yet does not count in delivery ratio and "
    "reach") {
    Line net(2);
    net.send(a, everyone, "first");
    net.run_for(1s);
    net.send(a, everyone, "too late");
    net.run_for(1us);
    CHECK(net.metrics().delivery_ratio == 0.5);
    net.finish();
    const MetricValues values = net.metrics();
    CHECK(values.messages == 2);
    CHECK(values.cut_off == 1);
    CHECK(dropped(values, "END") == 1);
    CHECK(values.delivery_ratio == 1.0);
    CHECK(values.reach == 1.0);
}

TEST_CASE(
    "end of the run: a broadcast does not count as cut off if a robot has received it, or if none "
    "can hear it") {
    Line net(3);
    net.run_for(1s);
    net.send(a, everyone, "on its way");
    net.run_for(1ms);  // b has it, and waits to pass it on
    net.finish();
    CHECK(net.metrics().cut_off == 0);
    CHECK(net.metrics().delivery_ratio == 0.5);

    Line alone(1);
    alone.add({.name = "far", .at = {1000, 0, 0}});
    alone.send(a, everyone, "nobody");
    alone.finish();
    CHECK(alone.metrics().cut_off == 0);
    CHECK(alone.metrics().delivery_ratio == 0.0);
}

TEST_CASE(
    "end of the run: a unicast that waits at a robot on its route counts as dropped by this "
    "robot") {
    const auto check = [](Router protocol) {
        Network net(Line::of({.access = Csma{}}));
        net.route(std::move(protocol));
        for (int i = 0; i < 3; ++i) net.add({.name = "", .at = {10.0 * i, 0, 0}});
        const auto losers = std::make_shared<Losers>();
        net.add_sink(losers);
        net.send(a, c, "arrives");
        net.run_for(1s);
        net.switch_off(c);
        net.send(a, c, "waits at b");
        net.run_for(100ms);
        net.finish();
        const MetricValues values = net.metrics();
        CHECK(values.messages == 2);
        CHECK(values.deliveries == 1);
        CHECK(values.delivery_ratio == 0.5);
        CHECK(dropped(values, "END") == 1);
        std::uint64_t all = 0;
        for (const DropCount& each : values.drops) all += each.count;
        CHECK(all == 1);
        REQUIRE(!losers->robots.empty());
        CHECK(losers->robots.back() == b);
    };
    check(Aodv{.local_repair = true});
    check(Dsr{.profile = DsrProfile::ns2});
}

TEST_CASE("unicast: a unicast that its destination cannot hear is dropped with a reason") {
    Line net(3);
    net.send(a, c, "too far");
    net.run_for(1s);
    net.finish();
    const MetricValues values = net.metrics();
    CHECK(values.delivery_ratio == 0.0);
    CHECK(dropped(values, "OOR") == 1);
    CHECK(values.cut_off == 0);
}

TEST_CASE(
    "unicast: a message counts for the metric `reach` only if a chain of links leads to its "
    "destination") {
    Line net(4);
    net.send(a, b, "near");
    net.run_for(1s);
    CHECK(net.metrics().reach == 1.0);
    net.send(a, c, "reachable, if somebody relayed");
    net.run_for(1s);
    CHECK(net.metrics().reach == 0.5);
    net.switch_off(b);
    net.send(a, c, "not reachable: it does not count");
    net.run_for(1s);
    CHECK(net.metrics().reach == 0.5);
}

TEST_CASE("flows: messages are counted for each flow, and deliveries for each robot") {
    Line net(3, {.metric_parts = {.flows = true, .robots = true}});
    net.send(a, everyone, "one", {.size = 100, .flow = 1});
    net.run_for(1s);
    net.send(a, c, "two", {.size = 50, .flow = 2});
    net.send(c, b, "two", {.size = 50, .flow = 2});
    net.send(b, everyone, "of no flow");
    net.run_for(1s);
    const MetricValues values = net.metrics();
    REQUIRE(values.flows.size() == 2);
    CHECK(values.flows[0].messages == 1);
    CHECK(values.flows[0].deliveries == 2);
    CHECK(values.flows[0].delivery_ratio() == 1.0);
    CHECK(values.flows[0].bytes == 200);
    CHECK(values.flows[1].messages == 2);
    CHECK(values.flows[1].delivery_ratio() == 0.5);
    REQUIRE(values.robots.size() == 3);
    CHECK(values.robots[0].messages == 1);  // what b says
    CHECK(values.robots[0].delivery_ratio() == 1.0);
    CHECK(values.robots[1].messages == 2);
    CHECK(values.robots[1].delivery_ratio() == 1.0);
    CHECK(values.robots[2].messages == 3);
    CHECK(values.robots[2].deliveries == 2);
}

}  // namespace run_end_test
