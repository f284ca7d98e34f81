// SPDX-License-Identifier: MIT
// Who may link with whom, and frames that do not get through.
#include "experiment/reports/link_table.hpp"
#include "models/access/list.hpp"
#include "models/reception/list.hpp"
#include "network/network.hpp"
#include "routing/dsr.hpp"
#include "routing/flood.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <string>
#include <vector>

namespace radio_gate_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

/// How many of two robots side by side hear each other, by their radios.
int links_between(const Radio& a, const Radio& b) {
    Network net;
    const NodeId first = net.add({.name = "a", .at = {}, .radio = a});
    const NodeId second = net.add({.name = "b", .at = {1, 0, 0}, .radio = b});
    net.route(Flood{.ttl = 1});
    net.send(first, everyone, "x");
    net.run_for(1s);
    const auto heard = net.links(second, net.now()).size();
    CHECK(net.metrics().receptions == heard);  // the table and the medium agree
    return static_cast<int>(heard + net.links(first, net.now()).size());
}

/// Frames that got through of 2000, and those that did not.
std::pair<std::uint64_t, std::uint64_t> through(double success_rate, bool crowd,
                                                const ReceptionModel& reception = Threshold{}) {
    Network net({.seed = 5, .propagation = Friis{}, .reception = reception});
    net.route(Flood{.ttl = 1});
    if (crowd) net.add({.name = "far", .at = {500, 0, 0}});
    const NodeId a = net.add({.name = "a", .at = {}, .radio = {.success_rate = success_rate}});
    net.add({.name = "b", .at = {1, 0, 0}});
    for (int i = 0; i < 2000; ++i) {
        net.send(a, everyone, "x");
        net.run_for(1ms);
    }
    net.run_for(1s);
    std::uint64_t errors = 0;
    for (const auto& drop : net.metrics().drops) {
        if (std::string(drop.reason) == "ERR") errors = drop.count;
    }
    return {net.metrics().deliveries, errors};
}

}  // namespace

TEST_CASE("success rate: if a frame is sent again, a new random draw decides on reception") {
    for (const AccessModel& access : std::vector<AccessModel>{NoAccess{}, Aloha{}}) {
        Network net({.seed = 5, .propagation = Friis{}, .access = access});
        net.route(Dsr{});
        const NodeId a = net.add({.name = "a", .at = {}, .radio = {.success_rate = 0.8}});
        const NodeId b = net.add({.name = "b", .at = {1, 0, 0}});
        for (int i = 0; i < 100; ++i) {
            net.send(a, b, "x");
            net.run_for(100ms);
        }
        net.run_for(60s);
        CHECK(net.metrics().deliveries == 100);
        CHECK(net.metrics().transmissions < 400);
    }
}

TEST_CASE(
    "radio gate: two radios are linked only if their essids are equal or one essid is \"any\"") {
    CHECK(links_between({.essid = "x"}, {.essid = "x"}) == 2);
    CHECK(links_between({.essid = "x"}, {.essid = "y"}) == 0);
    CHECK(links_between({.essid = "x"}, {.essid = "any"}) == 2);
    CHECK(links_between({}, {}) == 2);
}

TEST_CASE("radio gate: links need the same channel and frequency") {
    CHECK(links_between({.channel = 1}, {.channel = 1}) == 2);
    CHECK(links_between({.channel = 1}, {.channel = 6}) == 0);
    CHECK(links_between({.frequency = {2412e6}}, {.frequency = {2437e6}}) == 0);
}

TEST_CASE("radio gate: if either radio has the gate `none`, their essids and channels may differ") {
    CHECK(links_between({.essid = "x", .gate = Gate::none}, {.essid = "y"}) == 2);
    CHECK(links_between({.essid = "x"}, {.essid = "y", .channel = 3, .gate = Gate::none}) == 2);
}

TEST_CASE("success rate: the same frames are received under every reception model") {
    const auto expected = through(0.5, true);
    CHECK(expected.second > 900);
    CHECK(through(0.5, true, Collision{}) == expected);
    CHECK(through(0.5, true, Sinr{}) == expected);
}

TEST_CASE(
    "success rate: the given share of frames is received, and other frames are dropped with reason "
    "ERR") {
    for (const double rate : {0.3, 0.9}) {
        const auto [delivered, errors] = through(rate, false);
        CHECK(delivered + errors == 2000);
        const double four_sigma = 4 * std::sqrt(2000 * rate * (1 - rate));
        CHECK(std::abs(static_cast<double>(delivered) - 2000 * rate) < four_sigma);
    }
    CHECK(through(1, false).second == 0);
    CHECK(through(0, false).first == 0);
}

TEST_CASE("success rate: adding a robot does not change which frames are received") {
    CHECK(through(0.5, false) == through(0.5, true));
}

TEST_CASE("addresses: IP addresses that are generated differ from those given by the user") {
    Network net;
    net.add({.name = "a", .at = {}});
    net.add({.name = "b", .at = {}, .radio = {.labels = {.ip = "10.0.0.1"}}});
    net.add({.name = "c", .at = {}});
    const auto all = devices(net);
    CHECK(all[0].ip != "10.0.0.1");
    CHECK(all[1].ip == "10.0.0.1");
    CHECK(all[2].ip == "10.0.0.3");
    CHECK(all[0].ip != all[2].ip);
}

}  // namespace radio_gate_test
