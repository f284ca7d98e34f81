// SPDX-License-Identifier: MIT
#include "models/link_gain.hpp"

#include "models/medium/medium.hpp"
#include "models/propagation/log_distance.hpp"
#include "test/models/vectors.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace link_gain_test {
using namespace rovernet;
using test::near;

namespace {

/// A few roundings of levels up to 200 dB.
constexpr double tolerance = 1e-12;  // [dB]

}  // namespace

TEST_CASE("link gain: two radios with the default values have a link budget of 91.53 dB") {
    constexpr double half_a_digit = 0.005;  // [dB]
    CHECK(near(link_budget(Radio{}, Radio{}).value, 91.53, half_a_digit));
}

TEST_CASE("link gain: the link budget is power plus gains minus cable losses minus sensitivity") {
    const Radio base{.power = 20_dBm, .antenna_gain = 5_dB, .cable_loss = 2_dB};
    const Radio robot{.sensitivity = -90_dBm, .antenna_gain = 3_dB, .cable_loss = 0.5_dB};
    // 20 + 5 - 2 + 3 - 0.5 + 90
    CHECK(near(link_budget(base, robot).value, 115.5, tolerance));
}

TEST_CASE("link gain: a sensitivity that is 10 dB worse makes the link budget 10 dB smaller") {
    const Radio deaf{.sensitivity = -70_dBm}, keen{.sensitivity = -80_dBm};
    CHECK(near((link_budget({}, keen) - link_budget({}, deaf)).value, 10, tolerance));
}

TEST_CASE("link gain: link budgets in both directions differ only by the difference of powers") {
    const Radio loud{.power = 20_dBm, .antenna_gain = 5_dB, .cable_loss = 2_dB};
    const Radio quiet{.power = 10_dBm, .antenna_gain = 3_dB};
    CHECK(near((link_budget(loud, quiet) - link_budget(quiet, loud)).value, 10, tolerance));
}

TEST_CASE("link gain: a path loss equal to the budget gives a level equal to the sensitivity") {
    const Radio from{.antenna_gain = 5_dB, .cable_loss = 2_dB};
    const Radio to{.sensitivity = -82_dBm, .antenna_gain = 1_dB, .cable_loss = 4_dB};
    CHECK(near(received_power(from, to, link_budget(from, to)).value, -82, tolerance));
}

TEST_CASE("link gain: the level and the margin of a link are computed from its path loss") {
    const Radio from{.power = 20_dBm, .antenna_gain = 5_dB, .cable_loss = 2_dB};
    const Radio to{.sensitivity = -90_dBm, .antenna_gain = 3_dB, .cable_loss = 0.5_dB};
    Legs legs;
    const Scene field;
    Medium medium({.scene = &field});
    for (const auto& [radio, x] : {std::pair{from, 0.0}, std::pair{to, 30.0}}) {
        medium.add(radio, 1, LogDistance{});
        legs.add({.from = {x, 0}});
    }
    const NodeId a{0}, b{1};
    const Db loss = medium.links().path_loss(a, b, start_of_run, legs);
    CHECK(near(medium.links().level(a, b, start_of_run, legs).value,
               20 + 5 - 2 + 3 - 0.5 - loss.value, tolerance));
    CHECK(
        near(medium.links().margin(a, b, start_of_run, legs).value, 115.5 - loss.value, tolerance));
    CHECK(medium.stations().pose(b, start_of_run, legs).antenna == Vec3{30, 0, 1});
}

TEST_CASE("link gain: a loss of 10,000 dB gives a finite level (S10)") {
    const Dbm level = received_power({.power = 40_dBm}, {}, 10000_dB);
    CHECK(near(level.value, 40 - 10000, tolerance));
    CHECK(near(received_power({.power = 40_dBm}, {}, 500_dB).value, -460, tolerance));
}

namespace {

constexpr double degree = 3.141592653589793 / 180;
constexpr double pattern_tolerance = 1e-9;  // [dB], of angles in degrees

/// Gain of a radio at the origin that heads along `heading`, towards an angle, both in degrees.
double gain_at(const Radio& radio, double angle, double heading = 0) {
    const Vec3 place{5 * std::cos(angle * degree), 5 * std::sin(angle * degree), 7};
    return pattern_gain(radio, {{0, 0, 1}, Radians{heading * degree}}, place).value;
}

}  // namespace

TEST_CASE("antennas: the gain table is interpolated linearly in dB, all around the circle") {
    const Radio radio{.antenna = AntennaShape::table,
                      .antenna_direction = Radians{30 * degree},
                      .antenna_pattern = {{{0, 0}, {90, -9}, {180, -20}, {270, -4}}}};
    for (const double turn : {0.0, 360.0, -720.0, 77.0}) {
        const auto gain = [&](double from_axis) {
            return gain_at(radio, turn + 30 + from_axis, turn);
        };
        CHECK(near(gain(0), 0, pattern_tolerance));
        CHECK(near(gain(30), -3, pattern_tolerance));
        CHECK(near(gain(135), -14.5, pattern_tolerance));
        CHECK(near(gain(-45), -2, pattern_tolerance));  // between 270 and 360
        CHECK(near(gain(-135), -12, pattern_tolerance));
    }
    CHECK(pattern_gain(radio, {}, {0, 0, 9}).value == 0);  // straight above
}

TEST_CASE(
    "antennas: a sector antenna loses 3 dB at half its beamwidth, and `front_to_back` dB behind") {
    for (const double width : {20.0, 60.0, 120.0, 300.0}) {
        const Radio radio{.antenna = AntennaShape::cosine,
                          .antenna_beamwidth = Radians{width * degree},
                          .front_to_back = Db{17}};
        CHECK(near(gain_at(radio, 0), 0, pattern_tolerance));
        CHECK(near(gain_at(radio, width / 2), -3, pattern_tolerance));
        CHECK(near(gain_at(radio, -width / 2), -3, pattern_tolerance));
        CHECK(near(gain_at(radio, 40 + width / 2, 40), -3, pattern_tolerance));
        CHECK(near(gain_at(radio, 180), -17, pattern_tolerance));
        for (double angle = 0; angle < 360; angle += 7) {
            CHECK(gain_at(radio, angle) <= 0);
            CHECK(gain_at(radio, angle) >= -17);
        }
    }
}

TEST_CASE("antennas: the poses of robots are used only if an antenna is directional") {
    const Radio plain{.antenna_gain = 2_dB, .cable_loss = 1_dB};
    Radio sector = plain;
    sector.antenna = AntennaShape::cosine;
    bool asked = false;
    const auto poses = [&] {
        asked = true;
        return std::pair{Pose{{0, 0, 0}, Radians{180 * degree}}, Pose{{9, 0, 0}, Radians{0}}};
    };
    CHECK(LinkGain::of(plain, plain, poses).sender == 1_dB);
    CHECK_FALSE(asked);
    const LinkGain gain = LinkGain::of(sector, plain, poses);
    CHECK(near(gain.sender.value, 1 - 20, pattern_tolerance));
    CHECK(gain.receiver == 1_dB);
    CHECK(near(LinkGain::of(plain, sector, poses).receiver.value, 1 - 20, pattern_tolerance));
}

TEST_CASE(
    "antennas: a gain table is refused if it is empty, exceeds 0 dB or has unordered angles") {
    const auto check = [](std::vector<PatternPoint> points) {
        check_antenna({.antenna = AntennaShape::table, .antenna_pattern = std::move(points)});
    };
    CHECK_NOTHROW(check({{0, 0}}));
    CHECK_NOTHROW(check({{-180, -3}, {0, 0}, {179, -2}}));
    CHECK_THROWS_AS(check({}), std::invalid_argument);
    CHECK_THROWS_AS(check({{0, 0.1}}), std::invalid_argument);
    CHECK_THROWS_AS(check({{0, 0}, {0, -1}}), std::invalid_argument);
    CHECK_THROWS_AS(check({{0, 0}, {360, -1}}), std::invalid_argument);
}

}  // namespace link_gain_test
