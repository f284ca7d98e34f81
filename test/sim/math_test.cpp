// SPDX-License-Identifier: MIT
#include "sim/math.hpp"

#include "test/sim/ulp.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace math_test {
using namespace rovernet;
using namespace rovernet::test;

namespace {

constexpr double log_bound_ulp = 1.0;     // as math.hpp states
constexpr double exp2_bound_ulp = 1.0;    // as math.hpp states
constexpr double exp10_bound_ulp = 1.1;   // as math.hpp states
constexpr double exp_bound_ulp = 1.0;     // as math.hpp states
constexpr double log1p_bound_ulp = 1.0;   // as math.hpp states
constexpr double expm1_bound_ulp = 1.3;   // as math.hpp states
constexpr double sincos_bound_ulp = 1.0;  // as math.hpp states
constexpr double atan2_bound_ulp = 1.6;   // as math.hpp states

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

// math::exp has an overload for complex numbers.
double real_exp(double x) { return math::exp(x); }
double sine(double x) { return math::sincos(x).sin; }
double cosine(double x) { return math::sincos(x).cos; }
double angle_of_line(double x) { return math::atan2(x, 1 - x); }

double worst_sincos_ulp(double from, double to) {
    const double sin = worst_ulp(
        sine, [](long double x) { return std::sin(x); }, from, to);
    const double cos = worst_ulp(
        cosine, [](long double x) { return std::cos(x); }, from, to);
    return std::max(sin, cos);
}

// For vectors in all directions, their coordinates apart by up to 2^spread.
double worst_atan2_ulp(int spread) {
    double worst = 0;
    for (int i = 0; i < samples; ++i) {
        const double y = std::ldexp(sample(3 * i, -1, 1), i % (spread + 1));
        const double x = sample(3 * i + 1, -1, 1);
        const long double exact =
            std::atan2(static_cast<long double>(y), static_cast<long double>(x));
        worst = std::max({worst, error_ulp(math::atan2(y, x), exact),
                          error_ulp(math::atan2(x, y), std::atan2(static_cast<long double>(x),
                                                                  static_cast<long double>(y)))});
    }
    return worst;
}

}  // namespace

TEST_CASE("logarithms: errors are below one unit in the last place, near 1 and far from it") {
    CHECK(worst_log_ulp(0.5, 2) < log_bound_ulp);
    CHECK(worst_log_ulp(0.999, 1.001) < log_bound_ulp);
    CHECK(worst_log_ulp(1.39, 1.43) < log_bound_ulp);  // where the range reduction jumps
    CHECK(worst_log_ulp(1, 1e6) < log_bound_ulp);
    CHECK(worst_log_ulp(1e-300, 1e-299) < log_bound_ulp);
    CHECK(worst_log_ulp(1e300, 1e308) < log_bound_ulp);
    CHECK(worst_log_ulp(0, Limits::min()) < log_bound_ulp);  // subnormal
}

TEST_CASE(
    "powers: errors are below the stated numbers of units in the last place, also for subnormal "
    "results") {
    CHECK(worst_ulp(math::exp2, long_exp2, -1, 1) < exp2_bound_ulp);
    CHECK(worst_ulp(math::exp2, long_exp2, -1022, 1024) < exp2_bound_ulp);
    CHECK(worst_ulp(math::exp2, long_exp2, -1075, -1022) < exp2_bound_ulp);
    const auto long_exp = [](long double x) { return std::exp(x); };
    CHECK(worst_ulp(real_exp, long_exp, -1, 1) < exp_bound_ulp);
    CHECK(worst_ulp(real_exp, long_exp, -708, 709.7) < exp_bound_ulp);
    CHECK(worst_ulp(real_exp, long_exp, -745, -708) < exp_bound_ulp);
    CHECK(worst_ulp(math::exp10, long_exp10, -1, 1) < exp10_bound_ulp);
    CHECK(worst_ulp(math::exp10, long_exp10, -307, 308) < exp10_bound_ulp);
    CHECK(worst_ulp(math::exp10, long_exp10, -323, -307) < exp10_bound_ulp);
}

TEST_CASE(
    "log(1 + x), e^x - 1: errors are below the stated numbers of units in the last place, near 0 "
    "and far from it") {
    const auto exact_log = [](long double x) { return std::log1p(x); };
    const auto log_ulp = [&](double a, double b) {
        return worst_ulp(math::log1p, exact_log, a, b);
    };
    CHECK(log_ulp(-1e-10, 1e-10) < log1p_bound_ulp);
    CHECK(log_ulp(-0.005, 0.005) < log1p_bound_ulp);  // where the ways part
    CHECK(log_ulp(-0.3, -0.2) < log1p_bound_ulp);
    CHECK(log_ulp(0.3, 0.5) < log1p_bound_ulp);
    CHECK(log_ulp(-1, 4) < log1p_bound_ulp);
    CHECK(log_ulp(1e15, 1e17) < log1p_bound_ulp);
    const auto exact_exp = [](long double x) { return std::expm1(x); };
    const auto exp_ulp = [&](double a, double b) {
        return worst_ulp(math::expm1, exact_exp, a, b);
    };
    CHECK(exp_ulp(-1e-10, 1e-10) < expm1_bound_ulp);
    CHECK(exp_ulp(-2, 2) < expm1_bound_ulp);
    CHECK(exp_ulp(-45, 0) < expm1_bound_ulp);
    CHECK(exp_ulp(0, 45) < expm1_bound_ulp);
    CHECK(exp_ulp(45, 709.7) < expm1_bound_ulp);
}

TEST_CASE(
    "log(1 + x), e^x - 1: values at 0, at infinity and at the pole are right, and zeros have the "
    "right sign") {
    CHECK(math::log1p(-1) == -Limits::infinity());
    CHECK(math::log1p(Limits::infinity()) == Limits::infinity());
    CHECK(math::expm1(-Limits::infinity()) == -1);
    CHECK(math::expm1(Limits::infinity()) == Limits::infinity());
    for (const double x : {-1.5, -Limits::infinity()}) CHECK(std::isnan(math::log1p(x)));
    for (const auto f : {math::log1p, math::expm1}) {
        for (const double x : {0.0, -0.0, Limits::denorm_min(), -1e-300}) CHECK(same_bits(f(x), x));
        CHECK(std::isnan(f(Limits::quiet_NaN())));
    }
}

TEST_CASE("logarithms: the result is exact wherever it is an integer") {
    for (int n = -1074; n <= 1023; ++n) CHECK(math::log2(std::ldexp(1.0, n)) == n);
    for (int n = 0; n <= 22; ++n) CHECK(math::log10(std::stod("1e" + std::to_string(n))) == n);
    CHECK(same_bits(math::log(1), 0.0));
    CHECK(same_bits(math::log2(1), 0.0));
    CHECK(same_bits(math::log10(1), 0.0));
}

TEST_CASE("powers: powers of 2 and 10 are exact wherever a double can represent them") {
    for (int n = -1074; n <= 1023; ++n) CHECK(math::exp2(n) == std::ldexp(1.0, n));
    for (int n = 0; n <= 22; ++n) CHECK(math::exp10(n) == std::stod("1e" + std::to_string(n)));
}

TEST_CASE(
    "logarithms: 0 gives -infinity, infinity gives infinity, negative numbers and NaN give NaN") {
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

TEST_CASE(
    "powers: overflow and infinity give infinity, underflow and -infinity give 0, NaN gives NaN") {
    for (const auto f : {math::exp, math::exp2, math::exp10}) {
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
    CHECK(math::exp(709.79) == Limits::infinity());
    CHECK(std::isfinite(math::exp(709.78)));
    CHECK(same_bits(math::exp(-745.2), 0.0));
    CHECK(math::exp(-745.1) == Limits::denorm_min());
    CHECK(math::exp10(308.3) == Limits::infinity());
    CHECK(std::isfinite(math::exp10(308.25)));
    CHECK(same_bits(math::exp10(-323.7), 0.0));
    CHECK(math::exp10(-323.5) == Limits::denorm_min());
}

TEST_CASE("logarithms: all compilers give the same bits") {
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

TEST_CASE("powers: all compilers give the same bits") {
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

TEST_CASE(
    "sine and cosine: errors are below one unit in the last place, in the first octant and after "
    "many turns") {
    CHECK(worst_sincos_ulp(-0.8, 0.8) < sincos_bound_ulp);
    CHECK(worst_sincos_ulp(-1e-5, 1e-5) < sincos_bound_ulp);
    CHECK(worst_sincos_ulp(0.785, 0.786) < sincos_bound_ulp);  // where the range reduction jumps
    CHECK(worst_sincos_ulp(-10, 10) < sincos_bound_ulp);
    CHECK(worst_sincos_ulp(-1e6, 1e6) < sincos_bound_ulp);
    CHECK(worst_sincos_ulp(-1e9, 1e9) < sincos_bound_ulp);
}

TEST_CASE("sine and cosine: near their zeros, errors are at most one unit in the last place") {
    // The doubles nearest to multiples of pi / 2; computed to 400 bits, then rounded.
    struct Known {
        double x, sin, cos;
    };
    const Known known[] = {
        {0x1.921fb54442d18p+0, 0x1p+0, 0x1.1a62633145c07p-54},
        {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53, -0x1p+0},
        {0x1.2d97c7f3321d2p+2, -0x1p+0, -0x1.a79394c9e8a0ap-53},
        {0x1.921fb54442d18p+2, -0x1.1a62633145c07p-52, 0x1p+0},
        {0x1.1475cc9eedf01p+5, -0x1.3ddc5bce200bbp-49, -0x1p+0},
        {0x1.62fffe0642fcfp+8, 0x1.b94adb917f93ep-46, -0x1p+0},
        {0x1.7f7ec53a8d491p+20, -0x1.eacd7c60e9693p-34, 0x1p+0},
        {0x1.dcd64ffb617e8p+29, -0x1.0cce51016c582p-26, 0x1.fffffffffffffp-1},
    };
    for (const auto& k : known) {
        CAPTURE(k.x);
        CHECK(error_ulp(math::sincos(k.x).sin, k.sin) <= 1);
        CHECK(error_ulp(math::sincos(k.x).cos, k.cos) <= 1);
    }
}

TEST_CASE(
    "sine and cosine: the sine is odd and the cosine even to the last bit, and both are exact at "
    "0") {
    CHECK(same_bits(sine(0.0), 0.0));
    CHECK(same_bits(sine(-0.0), -0.0));
    CHECK(same_bits(cosine(0.0), 1.0));
    CHECK(same_bits(sine(Limits::denorm_min()), Limits::denorm_min()));
    for (int i = 0; i < samples; ++i) {
        const double x = sample(i, 0, i % 2 == 0 ? 4 : 1e9);
        REQUIRE(same_bits(sine(-x), -sine(x)));
        REQUIRE(same_bits(cosine(-x), cosine(x)));
    }
}

TEST_CASE("sine and cosine: arguments beyond 1e9 radians, infinity and NaN give NaN") {
    CHECK(std::isfinite(sine(1e9)));
    for (const double x : {std::nextafter(1e9, 2e9), -2e9, Limits::max(), Limits::infinity(),
                           -Limits::infinity(), Limits::quiet_NaN()}) {
        CHECK(std::isnan(sine(x)));
        CHECK(std::isnan(cosine(x)));
    }
}

TEST_CASE("angles: errors of atan2 are below two units in the last place in every direction") {
    CHECK(worst_atan2_ulp(0) < atan2_bound_ulp);
    CHECK(worst_atan2_ulp(6) < atan2_bound_ulp);
    CHECK(worst_atan2_ulp(1000) < atan2_bound_ulp);
}

TEST_CASE("angles: atan2 is exact at multiples of an eighth of a turn") {
    constexpr double pi = 0x1.921fb54442d18p+1;
    for (const double r : {1.0, 0.3, 1e-320, 1e300, Limits::max(), Limits::infinity()}) {
        CAPTURE(r);
        CHECK(same_bits(math::atan2(0, r), 0.0));
        CHECK(same_bits(math::atan2(r, r), pi / 4));
        CHECK(same_bits(math::atan2(r, 0), pi / 2));
        CHECK(same_bits(math::atan2(r, -r), 3 * (pi / 4)));
        CHECK(same_bits(math::atan2(0, -r), pi));
        CHECK(same_bits(math::atan2(-0.0, -r), -pi));
        CHECK(same_bits(math::atan2(-r, -r), -3 * (pi / 4)));
        CHECK(same_bits(math::atan2(-r, 0), -pi / 2));
        CHECK(same_bits(math::atan2(-r, r), -pi / 4));
    }
    for (const double zero : {0.0, -0.0}) CHECK(same_bits(math::atan2(zero, -zero), 0.0));
}

TEST_CASE("angles: no intermediate value of atan2 overflows or underflows") {
    const double steepest = math::atan2(Limits::max(), Limits::denorm_min());
    CHECK(same_bits(steepest, math::atan2(1, 0)));
    CHECK(same_bits(math::atan2(Limits::denorm_min(), Limits::max()), 0.0));
    CHECK(same_bits(math::atan2(1, Limits::infinity()), 0.0));
    CHECK(same_bits(math::atan2(Limits::infinity(), -1), math::atan2(1, 0)));
    CHECK(same_bits(math::atan2(0x1p-1070, 0x1p-1071), math::atan2(2, 1)));
    CHECK(same_bits(math::atan2(0x1p1023, -0x1p1022), math::atan2(2, -1)));
    CHECK(std::isnan(math::atan2(Limits::quiet_NaN(), 1)));
    CHECK(std::isnan(math::atan2(1, Limits::quiet_NaN())));
}

TEST_CASE("sine, cosine, angles, e^x, e^x - 1, log(1 + x): all compilers give the same bits") {
    struct Turn {
        double x, sin, cos;
    };
    const Turn turns[] = {
        {0x1p-30, 0x1p-30, 0x1p+0},
        {0.1, 0x1.98eaecb8bcb2cp-4, 0x1.fd712f9a817c1p-1},
        {0.5, 0x1.eaee8744b05fp-2, 0x1.c1528065b7d5p-1},
        {0.7853981633974483, 0x1.6a09e667f3bccp-1, 0x1.6a09e667f3bcdp-1},
        {0.7853981633974484, 0x1.6a09e667f3bcdp-1, 0x1.6a09e667f3bccp-1},
        {1, 0x1.aed548f090ceep-1, 0x1.14a280fb5068cp-1},
        {1.5707963267948966, 0x1p+0, 0x1.1a62633145c07p-54},
        {2.5, 0x1.326af0dcfcab1p-1, -0x1.9a2f7ef858b7dp-1},
        {3.141592653589793, 0x1.1a62633145c07p-53, -0x1p+0},
        {-6.283185307179586, 0x1.1a62633145c07p-52, 0x1p+0},
        {22, -0x1.220a29f6eb9f4p-7, -0x1.fffadd8d4acdap-1},
        {355, -0x1.f9bd0307d1de3p-16, -0x1.fffffffc18e4cp-1},
        {100000, 0x1.24daa9c527e96p-5, -0x1.ffac3841b3da7p-1},
        {-1234567.875, 0x1.ecb02b0dab381p-2, -0x1.c0d7657423e83p-1},
        {500000000, -0x1.238976ee5f7a7p-2, -0x1.eacfa519daddcp-1},
        {1000000000, 0x1.1778cae83c69bp-1, 0x1.acff8c7364234p-1},
    };
    for (const auto& k : turns) {
        CAPTURE(k.x);
        CHECK(same_bits(sine(k.x), k.sin));
        CHECK(same_bits(cosine(k.x), k.cos));
    }
    struct Direction {
        double y, x, angle;
    };
    const Direction directions[] = {
        {0.001, 1, 0x1.0624d77516e16p-10},  {0.3, 0.7, 0x1.9e9bf3d20dc71p-2},
        {0.7, 0.3, 0x1.2a78b84fbf5fcp+0},   {2.5, -1, 0x1.f38892f1e0c88p+0},
        {-2.5, -7, -0x1.66377fe555c41p+1},  {-1e-09, -3, -0x1.921fb5438b91p+1},
        {1, 0x1p-40, 0x1.921fb54441d18p+0}, {1e+300, 3e-05, 0x1.921fb54442d18p+0},
        {5e-324, -1, 0x1.921fb54442d18p+1}, {1e-310, 3e-310, 0x1.4978fa3269ee1p-2},
    };
    for (const auto& k : directions) {
        CAPTURE(k.y);
        CHECK(same_bits(math::atan2(k.y, k.x), k.angle));
    }
    struct Power {
        double x, exp;
    };
    const Power powers[] = {
        {-740, 0x0.0000000000055p-1022},
        {-700.5, 0x1.4ff475c68ca02p-1011},
        {-33.25, 0x1.057322ef4a1c2p-48},
        {-1.5, 0x1.c8f87724b5c1dp-3},
        {-0x1p-60, 0x1p+0},
        {0x1p-30, 0x1.00000004p+0},
        {0.1, 0x1.1aec7b35a00d4p+0},
        {0.34657359027997264, 0x1.6a09e667f3bccp+0},
        {1, 0x1.5bf0a8b145769p+1},
        {2.5, 0x1.85d6fd931e0bbp+3},
        {7.3, 0x1.7213320377b28p+10},
        {123.456, 0x1.1428e1cbc0143p+178},
        {709.75, 0x1.ef85a11e73f2dp+1023},
    };
    for (const auto& k : powers) {
        CAPTURE(k.x);
        CHECK(same_bits(math::exp(k.x), k.exp));
    }
    CHECK(fingerprint(sine, -1e3, 1e3) == 0x8751fc7b1cc79e0a);
    CHECK(fingerprint(cosine, -1e3, 1e3) == 0x7979cc4a3222f19f);
    CHECK(fingerprint(angle_of_line, -3, 3) == 0x079ed690a4fd7668);
    CHECK(fingerprint(real_exp, -10, 10) == 0x7a50720c97576064);
    CHECK(fingerprint(math::log1p, -1, 3) == 0xc424f5d5bf945d08);
    CHECK(fingerprint(math::expm1, -10, 10) == 0x272fb7dd612e0eb7);
}

}  // namespace math_test
