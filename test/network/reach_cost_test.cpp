// SPDX-License-Identifier: MIT
// `reach` is looked for as long as that costs no more than the frames, or if somebody asks for it.
#include "mobility/waypoints.hpp"
#include "models/propagation/disc.hpp"
#include "network/network.hpp"
#include "routing/flood.hpp"

#include <doctest/doctest.h>

#include <optional>

namespace reach_cost_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

/// Two lines of 20 robots that do not hear each other. One robot moves, so that no answer is kept,
/// and messages cross one hop, so that each of them takes 20 searches and one frame.
MetricValues after_messages(int messages, std::optional<bool> reach) {
    NetworkSettings settings;
    settings.propagation = Disc{.range = {11}};
    settings.metric_parts.reach = reach;
    Network net(settings);
    net.route(Flood{.ttl = 1});
    for (int line = 0; line < 2; ++line) {
        for (int i = 0; i < 20; ++i) net.add({.name = "", .at = {10.0 * i, 1000.0 * line, 0}});
    }
    net.add({.name = "", .at = {0, 500, 0}, .move = Waypoints{{{0s, {0, 500}}, {100s, {9, 500}}}}});
    for (int i = 0; i < messages; ++i) {
        net.send(NodeId{0}, everyone, "x");
        net.run_for(10ms);
    }
    net.finish();
    return net.metrics();
}

}  // namespace

TEST_CASE(
    "reach: in a run with few messages, the metric `reach` is measured even without a request") {
    const MetricValues values = after_messages(100, {});
    CHECK(values.reach_known);
    CHECK(values.reach == 1.0 / 19);
}

TEST_CASE("reach: in a run with many messages, the metric `reach` is measured only on request") {
    const MetricValues cheap = after_messages(2'000, {});
    CHECK_FALSE(cheap.reach_known);
    CHECK_FALSE(cheap.reach);
    CHECK(cheap.messages == 2'000);
    const MetricValues asked = after_messages(2'000, true);
    CHECK(asked.reach == 1.0 / 19);
    CHECK(asked.delivery_ratio == cheap.delivery_ratio);
    CHECK_FALSE(after_messages(100, false).reach);
}

}  // namespace reach_cost_test
