// SPDX-License-Identifier: MIT
// A run whose time does not go on ends, and says which robot holds it up.
#include "network/network.hpp"
#include "sim/error.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <string>

namespace network_liveness_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

/// A movement that creeps: each leg takes `step`; the first `good` legs take 10 ms.
struct Creep {
    Duration step{1};
    int good = 3;
    Step next_leg(Mover& mover) {
        Leg leg = standing_leg(mover);
        leg.end = mover.now + (good-- > 0 ? Duration(10ms) : step);
        return leg;
    }
};

std::string stall(Network& net, Duration span) {
    try {
        net.run_for(span);
    } catch (const StalledRun& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE(
    "liveness: if a robot starts a movement each nanosecond, the error names robot and position") {
    for (const Duration step : {0ns, 1ns, 9ns}) {
        CAPTURE(step.count());
        Network net;
        net.add({.name = "good", .at = {}, .move = Creep{10ms}});
        net.add({.name = "stuck", .at = {3, 4, 0}, .move = Creep{step}});
        const std::string error = stall(net, 1s);
        CHECK(
            error.starts_with("robot \"stuck\" at (3.000000, 4.000000) m: 100000 events at 0.03"));
        CHECK(net.now() < start_of_run + 33ms);
    }
}

TEST_CASE(
    "liveness: if ten robots together keep the time from advancing, the run ends with an error") {
    Network net;
    for (int i = 0; i < 10; ++i) net.add({.name = {}, .at = {}, .move = Creep{0ns}});
    CHECK(stall(net, 1s).starts_with("robot \"r"));
}

TEST_CASE("liveness: many simultaneous events of different robots do not end the run") {
    Network net;
    for (int i = 0; i < 500; ++i) net.add({.name = {}, .at = {}, .move = Creep{1us, 1}});
    CHECK(stall(net, 11ms).empty());
    CHECK(net.events() > 500'000);
}

}  // namespace network_liveness_test
