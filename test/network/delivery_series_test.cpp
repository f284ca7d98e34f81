// SPDX-License-Identifier: MIT
#include "traces/delivery_series.hpp"

#include "models/propagation/disc.hpp"
#include "network/network.hpp"
#include "routing/flood.hpp"

#include <doctest/doctest.h>

#include <memory>

namespace delivery_series_test {
using namespace rovernet;
using namespace std::chrono_literals;

TEST_CASE(
    "delivery series: for each message in order of sending, the series has the share of robots "
    "reached") {
    Network net({.propagation = Disc{.range = Meters{10}}});
    net.route(Flood{.ttl = 5});
    const auto series = std::make_shared<DeliverySeries>();
    net.add_sink(series);
    const NodeId a = net.add({.name = "a", .at = {}});
    net.add({.name = "b", .at = {5, 0}});
    const NodeId c = net.add({.name = "c", .at = {50, 0}});
    net.at(Time{1s}, [&] { net.send(a, everyone, "one"); });
    net.at(Time{2s}, [&] { net.send(c, everyone, "two"); });
    net.at(Time{3s}, [&] { net.send(a, everyone, "three"); });
    net.run_for(4s);
    CHECK(series->sent() == std::vector<Time>{Time{1s}, Time{2s}, Time{3s}});
    CHECK(series->delivered() == std::vector<double>{0.5, 0, 0.5});
}

TEST_CASE("delivery series: the message of a lone robot reaches nobody") {
    Network net;
    net.route(Flood{});
    const auto series = std::make_shared<DeliverySeries>();
    net.add_sink(series);
    net.send(net.add({.name = "a", .at = {}}), everyone, "one");
    net.run_for(1s);
    CHECK(series->delivered() == std::vector<double>{0});
}

}  // namespace delivery_series_test
