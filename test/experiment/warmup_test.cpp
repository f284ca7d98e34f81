// SPDX-License-Identifier: MIT
#include "experiment/warmup.hpp"

#include "experiment/build.hpp"
#include "models/propagation/disc.hpp"
#include "network/network.hpp"
#include "routing/flood.hpp"
#include "scenario/document/toml.hpp"

#include <doctest/doctest.h>

namespace warmup_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

/// A message every second; B is deaf for the first part of the time.
Scenario deaf_until(const std::string& seconds, const std::string& warmup) {
    const std::string text = R"([scenario]
duration = "100 s"
[propagation]
model = "disc"
range = "10 m"
[[robot]]
name = "A"
at = ["0 m", "0 m"]
[[robot]]
name = "B"
at = ["5 m", "0 m"]
off = ["0 s"]
on = [")" + seconds + R"( s"]
[[traffic]]
from = "A"
payload = "F"
start = "1 s"
every = "1 s"
[study]
warmup = ")" + warmup + "\"\n";
    return read_scenario(parse_toml(text, "s.toml"), "s.toml");
}

}  // namespace

TEST_CASE(
    "warm-up: messages sent before the end of the warm-up, and their copies, are not counted") {
    Network net({.propagation = Disc{.range = Meters{10}}, .warmup = 2s});
    net.route(Flood{.ttl = 3});
    const NodeId a = net.add({.name = "a", .at = {}});
    net.add({.name = "b", .at = {5, 0}});
    net.add({.name = "c", .at = {9, 0}});
    net.at(Time{1'999'999'999ns}, [&] { net.send(a, everyone, "early"); });  // is received later
    net.run_until(Time{3s});
    const MetricValues before = net.metrics();
    CHECK(before.messages == 0);
    CHECK(before.transmissions == 0);
    CHECK(before.receptions == 0);
    CHECK(before.deliveries == 0);
    CHECK_FALSE(before.delivery_ratio);
    for (const DropCount& drop : before.drops) CHECK(drop.count == 0);
    net.send(a, everyone, "late");
    net.run_until(Time{4s});
    CHECK(net.metrics().messages == 1);
    CHECK(net.metrics().transmissions == 3);
    CHECK(net.metrics().receptions == 6);
    CHECK(net.metrics().delivery_ratio == 1.0);
}

TEST_CASE("warm-up: airtime includes only frames that begin after the end of the warm-up") {
    Network net({.propagation = Disc{.range = Meters{10}}, .warmup = 2s});
    net.route(Flood{.ttl = 3});
    const NodeId a = net.add({.name = "a", .at = {}});
    net.add({.name = "b", .at = {5, 0}});
    net.add({.name = "c", .at = {9, 0}});
    net.at(Time{1'999'999'999ns}, [&] { net.send(a, everyone, "early"); });
    net.run_until(Time{3s});
    const Radio radio;
    const auto frame = [&](int bytes) {
        return radio.preamble + from_seconds(8 * bytes / radio.rate.value);
    };
    CHECK(net.airtime() == 2 * frame(5));  // b and c pass it on
    net.send(a, everyone, "late");
    net.run_until(Time{4s});
    CHECK(net.airtime() == 2 * frame(5) + 3 * frame(4));
    const AirtimeValues values = airtime_values(net.airtime(), net.metrics());
    CHECK(values.total == seconds(net.airtime()));
    CHECK(values.per_byte == 1e6 * values.total / 8);  // of which two robots got 4 bytes each
    CHECK_FALSE(airtime_values(net.airtime(), {}).per_byte);
}

TEST_CASE("warm-up: a message sent exactly at the end of the warm-up is counted") {
    Network net({.propagation = Disc{.range = Meters{10}}, .warmup = 2s});
    net.route(Flood{});
    const NodeId a = net.add({.name = "a", .at = {}});
    net.at(Time{2s}, [&] { net.send(a, everyone, "one"); });
    net.run_until(Time{3s});
    CHECK(net.metrics().messages == 1);
}

TEST_CASE("warm-up: the end of the warm-up is given by the study, or found by MSER-5") {
    const auto warmup = [](const Scenario& scenario) {
        return warmup_of(scenario, network_settings(scenario));
    };
    CHECK(warmup(deaf_until("20", "7 s")) == Duration{7s});
    // Messages 1 ... 100 s; those up to 20 s reach nobody: the message of 21 s is the first.
    CHECK(warmup(deaf_until("20.5", "mser5")) == Duration{21s});
    CHECK(warmup(deaf_until("0.5", "mser5")) == Duration{0});
}

}  // namespace warmup_test
