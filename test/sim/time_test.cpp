// SPDX-License-Identifier: MIT
#include "sim/time.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace time_test {
using namespace rovernet;
using namespace std::chrono_literals;

TEST_CASE("time: seconds are converted to the nearest nanosecond") {
    CHECK(from_seconds(0) == 0ns);
    CHECK(from_seconds(0.1) == 100ms);
    CHECK(from_seconds(1.4e-9) == 1ns);
    CHECK(from_seconds(1.6e-9) == 2ns);
    CHECK(from_seconds(-1.4e-9) == -1ns);
    CHECK(from_seconds(-1.6e-9) == -2ns);
    CHECK(from_seconds(0.3) == from_seconds(0.1) + from_seconds(0.2));  // not so in double
    CHECK(from_seconds(std::numeric_limits<double>::denorm_min()) == 0ns);
}

TEST_CASE("time: half a nanosecond is rounded away from zero, and slightly less towards zero") {
    constexpr double step = 0x1p-10;  // [s] 976,562.5 ns
    for (int n = -9; n <= 9; n += 2) {
        CHECK(from_seconds(n * step).count() == std::llround(n * 976'562.5));
        CHECK(from_seconds(std::nextafter(n * step, 0)).count() == std::trunc(n * 976'562.5));
    }
}

TEST_CASE("time: up to 13 days, nanoseconds converted to seconds and back are unchanged") {
    constexpr std::int64_t thirteen_days = std::int64_t{1} << 50;
    for (std::int64_t n = 1; n < thirteen_days; n = n * 3 / 2 + 1) {
        CHECK(from_seconds(seconds(Duration{n})) == Duration{n});
        CHECK(from_seconds(seconds(Duration{-n})) == Duration{-n});
    }
    CHECK(seconds(Time{123456789ns}) == 0.123456789);
    CHECK(seconds(start_of_run) == 0);
}

TEST_CASE(
    "time: times up to 292 years, positive or negative, are accepted; longer times are refused") {
    CHECK(from_seconds(9.2e9).count() == 9200000000000000000);
    CHECK(from_seconds(-9.2e9).count() == -9200000000000000000);
    CHECK(start_of_run + from_seconds(9.2e9) < never);
    CHECK_THROWS_AS(from_seconds(9.2000001e9), std::invalid_argument);
    CHECK_THROWS_AS(from_seconds(-9.3e9), std::invalid_argument);
    CHECK_THROWS_AS(from_seconds(std::numeric_limits<double>::infinity()), std::invalid_argument);
    CHECK_THROWS_AS(from_seconds(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
    CHECK_THROWS_WITH(from_seconds(1e10),
                      "a time must be within +-9.2e9 s (292 years), got 10000000000.000000 s");
}

TEST_CASE("time: after 30 years a nanosecond still counts, which a double would lose (S33)") {
    const Time late = start_of_run + 1'000'000'000s;
    CHECK((late + 10us) - late == 10us);
    CHECK((late + 1ns) - late == 1ns);
}

TEST_CASE("time: 0.1 s plus 0.2 s equals 0.3 s, so events at these times are simultaneous (S34)") {
    CHECK(start_of_run + from_seconds(0.1) + from_seconds(0.2) == start_of_run + from_seconds(0.3));
}

}  // namespace time_test
