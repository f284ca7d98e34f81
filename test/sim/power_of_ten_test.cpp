// SPDX-License-Identifier: MIT
#include "sim/power_of_ten.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace power_of_ten_test {
using namespace rovernet;

TEST_CASE("power of ten: multiplying a decimal number by a power of ten rounds only once") {
    CHECK(times_power_of_ten(3730.3, -2) == 37.303);
    CHECK(times_power_of_ten(-0.7, -1) == -0.07);
    CHECK(times_power_of_ten(2412.3, 6) == 2412300000.0);
    CHECK(times_power_of_ten(1e22, -22) == 1);
    CHECK(times_power_of_ten(0.1, 0) == 0.1);
}

TEST_CASE(
    "power of ten: the sign is kept if the result is zero, overflows or underflows; NaN stays "
    "NaN") {
    CHECK(times_power_of_ten(0, 3) == 0);
    CHECK(std::signbit(times_power_of_ten(-0.0, 3)));
    CHECK(times_power_of_ten(1e308, 3) == HUGE_VAL);
    CHECK(times_power_of_ten(-1e308, 3) == -HUGE_VAL);
    CHECK(times_power_of_ten(5e-324, -3) == 0);
    CHECK(times_power_of_ten(HUGE_VAL, -3) == HUGE_VAL);
    CHECK(std::isnan(times_power_of_ten(std::numeric_limits<double>::quiet_NaN(), 3)));
}

}  // namespace power_of_ten_test
