// SPDX-License-Identifier: MIT
#include "sim/units.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <type_traits>

namespace units_test {
using namespace rovernet;

namespace {

constexpr double one_ulp_at_16 = 3.6e-15;  // of a level between 8 and 16 ... 32 dBm, at most
constexpr double round_trip = 1e-14;       // relative: an ulp of 300 dBm is 1.3e-14 of the power

bool near(double value, double expected, double tolerance) {
    return std::abs(value - expected) <= tolerance;
}

template <class T>
concept AddsToItself = requires(T a) {
    a + a;
};

}  // namespace

TEST_CASE("power to level: powers of real radios have their published levels") {
    CHECK(near(to_dbm({45}).value, 16.532125137753436, one_ulp_at_16));
    CHECK(near(to_dbm({30}).value, 14.771212547196624, one_ulp_at_16));
}

TEST_CASE("power to level: 1, 10 and 1000 mW are exactly 0, 10 and 30 dBm") {
    CHECK(to_dbm({1}).value == 0);
    CHECK(to_dbm({10}).value == 10);
    CHECK(to_dbm({1000}).value == 30);
}

TEST_CASE("power to level: a level converted to a power and back is unchanged") {
    for (double level = -150; level <= 60; level += 0.37) {
        CAPTURE(level);
        CHECK(near(to_dbm({std::pow(10, level / 10)}).value, level, round_trip * 10));
    }
}

TEST_CASE("power to level: only a positive power has a level") {
    CHECK_THROWS_WITH_AS(to_dbm({0}), "power must be > 0 mW, got 0 mW", std::invalid_argument);
    CHECK_THROWS_WITH_AS(to_dbm({-2.5}), "power must be > 0 mW, got -2.5 mW",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(to_dbm({std::numeric_limits<double>::quiet_NaN()}),
                         "power must be > 0 mW, got nan mW", std::invalid_argument);
    CHECK(std::isfinite(to_dbm({std::numeric_limits<double>::denorm_min()}).value));
}

TEST_CASE(
    "units: a level plus dB is a level, the difference of two levels is in dB, levels do not add") {
    CHECK(10_dBm + 3_dB == 13_dBm);
    CHECK(10_dBm - 3_dB == 7_dBm);
    CHECK(10_dBm - 4_dBm == 6_dB);
    CHECK(-(80_dBm) < -(79.5_dBm));
    static_assert(!AddsToItself<Dbm>);
    static_assert(AddsToItself<Db> && AddsToItself<MilliWatts> && AddsToItself<Meters>);
    static_assert(std::is_same_v<decltype(1_m / 2_m), double>);
}

TEST_CASE("units: literals apply the factor of their prefix, as 2450_MHz is 2.45e9 Hz") {
    CHECK((2450_MHz).value == 2.45e9);
    CHECK((5.5_Mbps).value == 5.5e6);
    CHECK(3 * 2_m + 1.5_m - 0.5_m == 7_m);
}

}  // namespace units_test
