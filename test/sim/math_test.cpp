// SPDX-License-Identifier: MIT
#include "sim/math.hpp"

#include "sim/random.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

using namespace rovernet;

namespace {

using Limits = std::numeric_limits<double>;
static_assert(std::numeric_limits<long double>::digits >= 64, "the oracle needs 11 bits to spare");

constexpr double log_bound_ulp = 1.0;    // as math.hpp states
constexpr double exp2_bound_ulp = 1.0;   // as math.hpp states
constexpr double exp10_bound_ulp = 1.1;  // as math.hpp states
constexpr int samples = 100'000;

// The distance of `value` from `exact` in units of the last place of `exact`.
double error_ulp(double value, long double exact) {
    const int exponent = std::max(std::ilogb(static_cast<double>(exact)), Limits::min_exponent - 1);
    return static_cast<double>(std::abs(value - exact) /
                               std::ldexp(1.0L, exponent - (Limits::digits - 1)));
}

double sample(int i, double from, double to) {
    return from + (to - from) * uniform({.purpose = Purpose::order, .index = std::uint64_t(i)});
}

template <class Function, class Oracle>
double worst_ulp(Function f, Oracle oracle, double from, double to) {
    double worst = 0;
    for (int i = 0; i < samples; ++i) {
        const double x = sample(i, from, to);
        worst = std::max(worst, error_ulp(f(x), oracle(static_cast<long double>(x))));
    }
    return worst;
}

double worst_log_ulp(double from, double to) {
    const double e = worst_ulp(
        math::log, [](long double x) { return std::log(x); }, from, to);
    const double two = worst_ulp(
        math::log2, [](long double x) { return std::log2(x); }, from, to);
    const double ten = worst_ulp(
        math::log10, [](long double x) { return std::log10(x); }, from, to);
    return std::max({e, two, ten});
}

long double long_exp2(long double x) { return std::exp2(x); }
long double long_exp10(long double x) { return std::pow(10.0L, x); }

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

// The bits of f over many arguments as one number.
template <class Function>
std::uint64_t fingerprint(Function f, double from, double to) {
    std::uint64_t sum = 0;
    for (int i = 0; i < samples; ++i) {
        sum = combine(sum, std::bit_cast<std::uint64_t>(f(sample(i, from, to))));
    }
    return sum;
}

}  // namespace

TEST_CASE("logarithms: below one ulp, near 1 and far from it") {
    CHECK(worst_log_ulp(0.5, 2) < log_bound_ulp);
    CHECK(worst_log_ulp(0.999, 1.001) < log_bound_ulp);
    CHECK(worst_log_ulp(1.39, 1.43) < log_bound_ulp);  // where the range reduction jumps
    CHECK(worst_log_ulp(1, 1e6) < log_bound_ulp);
    CHECK(worst_log_ulp(1e-300, 1e-299) < log_bound_ulp);
    CHECK(worst_log_ulp(1e300, 1e308) < log_bound_ulp);
    CHECK(worst_log_ulp(0, Limits::min()) < log_bound_ulp);  // subnormal
}

TEST_CASE("powers: below the stated ulps, in and out of the normal range") {
    CHECK(worst_ulp(math::exp2, long_exp2, -1, 1) < exp2_bound_ulp);
    CHECK(worst_ulp(math::exp2, long_exp2, -1022, 1024) < exp2_bound_ulp);
    CHECK(worst_ulp(math::exp2, long_exp2, -1075, -1022) < exp2_bound_ulp);
    CHECK(worst_ulp(math::exp10, long_exp10, -1, 1) < exp10_bound_ulp);
    CHECK(worst_ulp(math::exp10, long_exp10, -307, 308) < exp10_bound_ulp);
    CHECK(worst_ulp(math::exp10, long_exp10, -323, -307) < exp10_bound_ulp);
}

TEST_CASE("logarithms: exact wherever the result is an integer") {
    for (int n = -1074; n <= 1023; ++n) CHECK(math::log2(std::ldexp(1.0, n)) == n);
    for (int n = 0; n <= 22; ++n) CHECK(math::log10(std::stod("1e" + std::to_string(n))) == n);
    CHECK(same_bits(math::log(1), 0.0));
    CHECK(same_bits(math::log2(1), 0.0));
    CHECK(same_bits(math::log10(1), 0.0));
}

TEST_CASE("powers: exact wherever a double can be") {
    for (int n = -1074; n <= 1023; ++n) CHECK(math::exp2(n) == std::ldexp(1.0, n));
    for (int n = 0; n <= 22; ++n) CHECK(math::exp10(n) == std::stod("1e" + std::to_string(n)));
}

TEST_CASE("logarithms: zero, infinity, negative arguments, NaN") {
    for (const auto f : {math::log, math::log2, math::log10}) {
        CHECK(f(0.0) == -Limits::infinity());
        CHECK(f(-0.0) == -Limits::infinity());
        CHECK(f(Limits::infinity()) == Limits::infinity());
        CHECK(std::isnan(f(-1)));
        CHECK(std::isnan(f(-Limits::denorm_min())));
        CHECK(std::isnan(f(-Limits::infinity())));
        CHECK(std::isnan(f(Limits::quiet_NaN())));
    }
}

TEST_CASE("powers: overflow, underflow, infinity, NaN") {
    for (const auto f : {math::exp2, math::exp10}) {
        CHECK(f(0.0) == 1);
        CHECK(f(-0.0) == 1);
        CHECK(f(Limits::infinity()) == Limits::infinity());
        CHECK(same_bits(f(-Limits::infinity()), 0.0));
        CHECK(f(Limits::max()) == Limits::infinity());
        CHECK(same_bits(f(Limits::lowest()), 0.0));
        CHECK(std::isnan(f(Limits::quiet_NaN())));
    }
    CHECK(math::exp2(1024) == Limits::infinity());
    CHECK(std::isfinite(math::exp2(std::nextafter(1024, 0))));
    CHECK(same_bits(math::exp2(-1075.1), 0.0));
    CHECK(math::exp2(-1074.9) == Limits::denorm_min());
    CHECK(math::exp10(308.3) == Limits::infinity());
    CHECK(std::isfinite(math::exp10(308.25)));
    CHECK(same_bits(math::exp10(-323.7), 0.0));
    CHECK(math::exp10(-323.5) == Limits::denorm_min());
}

TEST_CASE("logarithms: the same bits from every compiler") {
    struct Known {
        double x, log, log2, log10;
    };
    const Known known[] = {
        {0x1p-1074, -0x1.74385446d71c3p+9, -0x1.0c8p+10, -0x1.434e6420f4374p+8},
        {0x1.23456789abcdep-700, -0x1.e512ee583676ep+8, -0x1.5de829fb69304p+9,
         -0x1.a55472f3d3b3fp+7},
        {1e-9, -0x1.4b927f32bffb8p+4, -0x1.de5b8eaa8d7ep+4, -0x1.2p+3},
        {0x1.6a09e667f3bccp-1, -0x1.62e42fefa39f1p-2, -0x1.0000000000001p-1, -0x1.34413509f7ap-3},
        {0x1.6a09e667f3bcdp-1, -0x1.62e42fefa39eep-2, -0x1.ffffffffffffep-2, -0x1.34413509f79fep-3},
        {0x1.fffffffffffffp-1, -0x1p-53, -0x1.71547652b82fep-53, -0x1.bcb7b1526e50fp-55},
        {0x1.0000000000001p+0, 0x1.fffffffffffffp-53, 0x1.71547652b82fdp-52, 0x1.bcb7b1526e50dp-54},
        {0x1.6a09e667f3bccp+0, 0x1.62e42fefa39eep-2, 0x1.ffffffffffffep-2, 0x1.34413509f79fep-3},
        {2.5, 0x1.d5240f0e0e078p-1, 0x1.5269e12f346e3p+0, 0x1.977d95ec10c02p-2},
        {3, 0x1.193ea7aad030bp+0, 0x1.95c01a39fbd68p+0, 0x1.e8927964fd5fdp-2},
        {45, 0x1.e740b76a3c9a4p+1, 0x1.5f7a8568cb06dp+2, 0x1.a738ef7000c7fp+0},
        {2.45e9, 0x1.59e8df983ce91p+4, 0x1.f30aca94ea47dp+4, 0x1.2c740c6ea1db8p+3},
        {0x1.fffffffffffffp+1023, 0x1.62e42fefa39efp+9, 0x1p+10, 0x1.34413509f79ffp+8},
    };
    for (const auto& k : known) {
        CAPTURE(k.x);
        CHECK(same_bits(math::log(k.x), k.log));
        CHECK(same_bits(math::log2(k.x), k.log2));
        CHECK(same_bits(math::log10(k.x), k.log10));
    }
    CHECK(fingerprint(math::log, 0, 4) == 0x1627e5ff1e741a6e);
    CHECK(fingerprint(math::log2, 0, 4) == 0x7de31036dbf6a33a);
    CHECK(fingerprint(math::log10, 0, 4) == 0x761265c39d001837);
}

TEST_CASE("powers: the same bits from every compiler") {
    struct Known {
        double x, exp2, exp10;
    };
    const Known known[] = {
        {-1050.3, 0x0.0000000cfefc6p-1022, 0x0p+0},
        {-300.7, 0x1.3b2c47bff8355p-301, 0x1.11a80ad45p-999},
        {-33.25, 0x1.ae89f995ad3adp-34, 0x1.75bd6b27d6467p-111},
        {-1.5, 0x1.6a09e667f3bcdp-2, 0x1.030dc4ea03a72p-5},
        {-0.5, 0x1.6a09e667f3bcdp-1, 0x1.43d136248490fp-2},
        {-0x1p-60, 0x1p+0, 0x1p+0},
        {0x1p-30, 0x1.00000002c5c86p+0, 0x1.0000000935d8ep+0},
        {0.1, 0x1.125fbee250664p+0, 0x1.4248ef8fc2604p+0},
        {0.30102999566398114, 0x1.3b65e78ad10a8p+0, 0x1.fffffffffffffp+0},
        {0.5, 0x1.6a09e667f3bcdp+0, 0x1.94c583ada5b53p+1},
        {1.6532125137753436, 0x1.929a40f8fa2c9p+1, 0x1.67ffffffffffdp+5},
        {7.3, 0x1.3b2c47bff8328p+7, 0x1.3073ef2652012p+24},
        {123.456, 0x1.5f29e9ad54c6dp+123, 0x1.14a8347c2096p+410},
        {300.1, 0x1.125fbee2506bp+300, 0x1.e13e2af95fa83p+996},
    };
    for (const auto& k : known) {
        CAPTURE(k.x);
        CHECK(same_bits(math::exp2(k.x), k.exp2));
        CHECK(same_bits(math::exp10(k.x), k.exp10));
    }
    CHECK(fingerprint(math::exp2, -10, 10) == 0x3ff5e80db304f017);
    CHECK(fingerprint(math::exp10, -10, 10) == 0x0a24e2851806d537);
}
