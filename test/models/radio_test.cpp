// SPDX-License-Identifier: MIT
#include "models/radio.hpp"

#include "test/models/vectors.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>

using namespace rovernet;
using test::near;

namespace {

/// A few roundings of levels up to 200 dB.
constexpr double tolerance = 1e-12;  // [dB]

}  // namespace

TEST_CASE("radio: the default's power is 45 mW") {
    constexpr double microwatt = 1e-3;  // [mW], far below what a data sheet can say
    CHECK(near(to_milliwatts(Radio{}.power).value, 45, microwatt));
}

TEST_CASE("radio: two devices of 2007 bridge 45 mW over -75 dBm, 91.53 dB") {
    constexpr double half_a_digit = 0.005;  // [dB]
    CHECK(near(link_budget(Radio{}, Radio{}).value, 91.53, half_a_digit));
}

TEST_CASE("radio: the budget by hand: gains add, cables subtract, sensitivity is subtracted") {
    const Radio base{.power = 20_dBm, .antenna_gain = 5_dB, .cable_loss = 2_dB};
    const Radio robot{.sensitivity = -90_dBm, .antenna_gain = 3_dB, .cable_loss = 0.5_dB};
    // 20 + 5 - 2 + 3 - 0.5 + 90
    CHECK(near(link_budget(base, robot).value, 115.5, tolerance));
}

TEST_CASE("radio: a deafer receiver has a smaller budget") {
    const Radio deaf{.sensitivity = -70_dBm}, keen{.sensitivity = -80_dBm};
    CHECK(near((link_budget({}, keen) - link_budget({}, deaf)).value, 10, tolerance));
}

TEST_CASE("radio: the two directions of a link differ by powers and sensitivities only") {
    const Radio loud{.power = 20_dBm, .antenna_gain = 5_dB, .cable_loss = 2_dB};
    const Radio quiet{.power = 10_dBm, .antenna_gain = 3_dB};
    CHECK(near((link_budget(loud, quiet) - link_budget(quiet, loud)).value, 10, tolerance));
}

TEST_CASE("radio: a path that uses up the budget arrives at the sensitivity") {
    const Radio from{.antenna_gain = 5_dB, .cable_loss = 2_dB};
    const Radio to{.sensitivity = -82_dBm, .antenna_gain = 1_dB, .cable_loss = 4_dB};
    CHECK(near(received_power(from, to, link_budget(from, to)).value, -82, tolerance));
}

TEST_CASE("radio: 64 bytes at 11 Mb/s behind a long preamble take 238,545 ns") {
    CHECK(airtime(Radio{}, 64) == Duration{192'000 + 46'545});  // 512 / 11 us = 46.5454 us
}

TEST_CASE("radio: the airtime is rounded to the nearest nanosecond; no byte takes the preamble") {
    CHECK(airtime(Radio{}, 0) == Duration{192'000});
    CHECK(airtime({.rate = 11_Mbps, .preamble = Duration{0}}, 1) == Duration{727});
    CHECK(airtime({.rate = 3_Mbps, .preamble = Duration{0}}, 1) == Duration{2667});
    CHECK(airtime({.rate = 1_Mbps, .preamble = Duration{0}}, 0xffffffff) ==
          Duration{34'359'738'360'000});
}

TEST_CASE("radio: the noise floors of the vectors, with the CODATA value of k") {
    const test::Vectors vectors("noise_floor.csv");
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const Hertz bandwidth{vectors.number(i, "bandwidth_Hz")};
        const Db figure{vectors.number(i, "NF_dB")};
        CAPTURE(bandwidth.value);
        CHECK(near(noise_floor(bandwidth, figure).value,
                   vectors.number(i, "kTB_dBm(CODATA k,290K)"), test::vector_tolerance));
        CHECK(noise_floor({.bandwidth = bandwidth, .noise_figure = figure}) ==
              noise_floor(bandwidth, figure));
    }
}
