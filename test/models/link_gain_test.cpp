// SPDX-License-Identifier: MIT
#include "models/link_gain.hpp"

#include "models/medium/medium.hpp"
#include "models/propagation/log_distance.hpp"
#include "test/models/vectors.hpp"

#include <doctest/doctest.h>

using namespace rovernet;
using test::near;

namespace {

/// A few roundings of levels up to 200 dB.
constexpr double tolerance = 1e-12;  // [dB]

}  // namespace

TEST_CASE("link gain: two devices of 2007 bridge 45 mW over -75 dBm, 91.53 dB") {
    constexpr double half_a_digit = 0.005;  // [dB]
    CHECK(near(link_budget(Radio{}, Radio{}).value, 91.53, half_a_digit));
}

TEST_CASE("link gain: the budget by hand: gains add, cables subtract, sensitivity is subtracted") {
    const Radio base{.power = 20_dBm, .antenna_gain = 5_dB, .cable_loss = 2_dB};
    const Radio robot{.sensitivity = -90_dBm, .antenna_gain = 3_dB, .cable_loss = 0.5_dB};
    // 20 + 5 - 2 + 3 - 0.5 + 90
    CHECK(near(link_budget(base, robot).value, 115.5, tolerance));
}

TEST_CASE("link gain: a deafer receiver has a smaller budget") {
    const Radio deaf{.sensitivity = -70_dBm}, keen{.sensitivity = -80_dBm};
    CHECK(near((link_budget({}, keen) - link_budget({}, deaf)).value, 10, tolerance));
}

TEST_CASE("link gain: the two directions of a link differ by powers and sensitivities only") {
    const Radio loud{.power = 20_dBm, .antenna_gain = 5_dB, .cable_loss = 2_dB};
    const Radio quiet{.power = 10_dBm, .antenna_gain = 3_dB};
    CHECK(near((link_budget(loud, quiet) - link_budget(quiet, loud)).value, 10, tolerance));
}

TEST_CASE("link gain: a path that uses up the budget arrives at the sensitivity") {
    const Radio from{.antenna_gain = 5_dB, .cable_loss = 2_dB};
    const Radio to{.sensitivity = -82_dBm, .antenna_gain = 1_dB, .cable_loss = 4_dB};
    CHECK(near(received_power(from, to, link_budget(from, to)).value, -82, tolerance));
}

TEST_CASE("link gain: the medium's level and margin are those of the path loss between two nodes") {
    const Radio from{.power = 20_dBm, .antenna_gain = 5_dB, .cable_loss = 2_dB};
    const Radio to{.sensitivity = -90_dBm, .antenna_gain = 3_dB, .cable_loss = 0.5_dB};
    Legs legs;
    Medium medium({});
    for (const auto& [radio, x] : {std::pair{from, 0.0}, std::pair{to, 30.0}}) {
        medium.add(radio, 1, LogDistance{});
        legs.add({.from = {x, 0}});
    }
    const NodeId a{0}, b{1};
    const Db loss = medium.path_loss(a, b, start_of_run, legs);
    CHECK(near(medium.level(a, b, start_of_run, legs).value, 20 + 5 - 2 + 3 - 0.5 - loss.value,
               tolerance));
    CHECK(near(medium.margin(a, b, start_of_run, legs).value, 115.5 - loss.value, tolerance));
    CHECK(medium.pose(b, start_of_run, legs).antenna == Vec3{30, 0, 1});
}

TEST_CASE("link gain: a loss of 10,000 dB leaves a level, not minus infinity (S10)") {
    const Dbm level = received_power({.power = 40_dBm}, {}, 10000_dB);
    CHECK(near(level.value, 40 - 10000, tolerance));
    CHECK(near(received_power({.power = 40_dBm}, {}, 500_dB).value, -460, tolerance));
}
