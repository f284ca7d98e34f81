// SPDX-License-Identifier: MIT
#include "sim/math.hpp"
#include "test/sim/ulp.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace math_erf_test {
using namespace rovernet;
using namespace rovernet::test;

namespace {

constexpr double bound_ulp = 6;  // as math.hpp states; of the smallest normal number in subnormals

double worst_erfc_ulp(double from, double to) {
    return worst_ulp(
        math::erfc, [](long double x) { return std::erfc(x); }, from, to);
}

}  // namespace

TEST_CASE(
    "erfc: errors are below the stated number of units in the last place, also far in the tail") {
    CHECK(worst_erfc_ulp(-0.5, 0.5) < bound_ulp);
    CHECK(worst_erfc_ulp(0.49, 0.51) < bound_ulp);  // where the ways part
    CHECK(worst_erfc_ulp(0.5, 4) < bound_ulp);
    CHECK(worst_erfc_ulp(4, 26.5) < bound_ulp);
    CHECK(worst_erfc_ulp(-7, -0.5) < bound_ulp);
    CHECK(worst_erfc_ulp(26.5, 27.3) < bound_ulp);
}

TEST_CASE("erfc: values equal those of a published table") {
    // M. Abramowitz and I. Stegun, Handbook of Mathematical Functions, table 7.1: erf x to 10
    // digits.
    constexpr double half_a_digit = 0.5e-10;
    CHECK(std::abs(1 - math::erfc(0.5) - 0.5204998778) < half_a_digit);
    CHECK(std::abs(1 - math::erfc(1) - 0.8427007929) < half_a_digit);
    CHECK(std::abs(1 - math::erfc(2) - 0.9953222650) < half_a_digit);
}

TEST_CASE("erfc: erfc(x) and erfc(-x) add up to 2, and erfc never increases") {
    double before = 2;
    for (double x = -6.5; x < 28; x += 1e-3) {
        const double here = math::erfc(x);
        CHECK(here <= before);
        before = here;
        CHECK(std::abs(here + math::erfc(-x) - 2) <= 0x1p-51);
    }
}

TEST_CASE("erfc: values at 0, at infinity and after underflow are exact; NaN gives NaN") {
    CHECK(math::erfc(0.0) == 1);
    CHECK(math::erfc(-0.0) == 1);
    CHECK(same_bits(math::erfc(Limits::infinity()), 0.0));
    CHECK(math::erfc(-Limits::infinity()) == 2);
    CHECK(math::erfc(27.22) > 0);
    CHECK(same_bits(math::erfc(27.3), 0.0));
    CHECK(same_bits(math::erfc(Limits::max()), 0.0));
    CHECK(std::isnan(math::erfc(Limits::quiet_NaN())));
}

TEST_CASE("erfc: all compilers give the same bits") {
    CHECK(fingerprint(math::erfc, -1, 1) == 0x6437ae6e5157df31);
    CHECK(fingerprint(math::erfc, 1, 28) == 0x54f0693c35006250);
}

}  // namespace math_erf_test
