// SPDX-License-Identifier: MIT
#include "sim/math.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace rovernet::math {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// Even and odd terms apart: half the latency of Horner's rule.
template <std::size_t N>
double polynomial(const std::array<double, N>& c, double x) {
    static_assert(N % 2 == 1);
    const double x2 = x * x;
    double even = c[N - 1];
    double odd = 0;
    for (std::size_t i = N - 1; i > 0; i -= 2) {
        odd = odd * x2 + c[i - 1];
        even = even * x2 + c[i - 2];
    }
    return even + x * odd;
}

struct LogBase {
    double scale_hi, scale_lo;  // 1 / ln(base); hi has 31 bits
    double two_hi, two_lo;      // the logarithm of 2; hi has 40 bits
};
constexpr LogBase base_e{1, 0, 0x1.62e42fefa2p-1, 0x1.9ef35793c7673p-41};
constexpr LogBase base_2{0x1.7154765p+0, 0x1.5c17f0bbbe88p-31, 1, 0};
constexpr LogBase base_10{0x1.bcb7b15p-2, 0x1.37287195355bbp-33, 0x1.34413509f6p-2,
                          0x1.9fef311f12b36p-42};

// (2 atanh(s) - 2 s) / s^3 in s^2, for |s| <= (sqrt 2 - 1) / (sqrt 2 + 1); minimax, error 3e-16.
constexpr std::array<double, 7> atanh_tail{
    0x1.5555555555558p-1, 0x1.9999999995224p-2, 0x1.2492492e03df2p-2, 0x1.c71c62d04637p-3,
    0x1.7462ba254dcfbp-3, 0x1.39fdb9a93a519p-3, 0x1.2b5fb9f34d9dep-3};

// x = 2^e (1 + f) with 1 + f in [sqrt 1/2, sqrt 2); ln(1 + f) = 2 atanh(f / (2 + f)), summed as
// f - f^2/2 + s (f^2/2 + s^2 tail) in two parts. Method: FreeBSD msun, k_log.h and e_log2.c.
double scaled_log(double x, const LogBase& base) {
    if (!(x > 0)) return x == 0 ? -infinity : not_a_number;
    if (x == infinity) return infinity;
    const bool subnormal = x < std::numeric_limits<double>::min();
    const auto image = std::bit_cast<std::int64_t>(subnormal ? x * 0x1p54 : x);

    constexpr auto sqrt_half = std::int64_t{0x3fe6a09e667f3bcd};
    const std::int64_t e = (image - sqrt_half) >> 52;
    const double f = std::bit_cast<double>(image - (e << 52)) - 1;
    const double exponent = static_cast<double>(subnormal ? e - 54 : e);

    const double s = f / (2 + f);
    const double half_square = 0.5 * f * f;
    const double z = s * s;
    const double rest = s * (half_square + z * polynomial(atanh_tail, z));
    const auto upper_half = std::uint64_t{0xffffffff00000000};  // 21 bits: hi * scale_hi is exact
    const double hi =
        std::bit_cast<double>(std::bit_cast<std::uint64_t>(f - half_square) & upper_half);
    const double lo = (f - hi) - half_square + rest;

    const double whole = exponent * base.two_hi;
    const double part = hi * base.scale_hi;
    const double sum = whole + part;
    const double error = (whole - sum) + part;
    return sum +
           (error + (lo * base.scale_hi + (lo + hi) * base.scale_lo + exponent * base.two_lo));
}

struct PowerBase {
    double limit;            // overflow or underflow beyond
    double log2;             // of the base
    double two_hi, two_lo;   // the logarithm of 2 to this base; hi has 40 bits
    double slope, slope_lo;  // ln(base)
    std::array<double, 11> curve;
};
// curve: (base^r - 1 - slope r) / r^2 for base^|r| <= sqrt 2; minimax, error 2e-19 of base^r.
constexpr PowerBase power_of_2{
    .limit = 1100,
    .log2 = 1,
    .two_hi = 1,
    .two_lo = 0,
    .slope = 0x1.62e42fefa39efp-1,
    .slope_lo = 0x1.abc9e3b39803fp-56,
    .curve = {0x1.ebfbdff82c58fp-3, 0x1.c6b08d704a0c2p-5, 0x1.3b2ab6fba4e79p-7,
              0x1.5d87fe78a526dp-10, 0x1.430912f86b053p-13, 0x1.ffcbfc671259ap-17,
              0x1.62c022455b7d3p-20, 0x1.b524fad85028ep-24, 0x1.e4cf04d01b988p-28,
              0x1.e9d419ddfe501p-32, 0x1.c4b5df1aba6c2p-36}};
constexpr PowerBase power_of_10{
    .limit = 340,
    .log2 = 0x1.a934f0979a371p+1,
    .two_hi = 0x1.34413509f6p-2,
    .two_lo = 0x1.9fef311f12b36p-42,
    .slope = 0x1.26bb1bbb55516p+1,
    .slope_lo = -0x1.f48ad494ea3e9p-53,
    .curve = {0x1.53524c73cea69p+1, 0x1.0470591de2ca6p+1, 0x1.2bd7609fd98c6p+0,
              0x1.1429ffd1d3d0ep-1, 0x1.a7ed70847aa41p-3, 0x1.16e4dfcb1e6bep-4,
              0x1.4116b069ce847p-6, 0x1.4897927843501p-8, 0x1.2ea4fb664c328p-10,
              0x1.fbe2f08961912p-13, 0x1.85d4096261800p-15}};

// 2^n for a normal result.
double power_of_two(int n) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + n) << 52);
}

// base^x = 2^n base^r, with n the integer nearest to x log2(base), r = x - n log(2) in two parts.
double power(const PowerBase& base, double x) {
    if (!(std::abs(x) < base.limit)) return x > 0 ? infinity : x < 0 ? 0 : not_a_number;
    constexpr double round = 0x1.8p52;  // adding it leaves no bits for a fraction
    const double n = (x * base.log2 + round) - round;
    const double r_hi = x - n * base.two_hi;
    const double r = r_hi - n * base.two_lo;
    const double r_lo = (r_hi - r) - n * base.two_lo;

    const double line = r * base.slope;
    const double sum = 1 + line;
    const double error = (1 - sum) + line;
    const double rest = r * r * polynomial(base.curve, r) + (r * base.slope_lo + r_lo * base.slope);
    const double y = sum + (error + rest);

    const int exponent = static_cast<int>(n);
    const int half = exponent / 2;  // in two steps, as 2^n may overflow or be subnormal alone
    return y * power_of_two(half) * power_of_two(exponent - half);
}

}  // namespace

double log(double x) { return scaled_log(x, base_e); }
double log2(double x) { return scaled_log(x, base_2); }
double log10(double x) { return scaled_log(x, base_10); }
double exp2(double x) { return power(power_of_2, x); }
double exp10(double x) { return power(power_of_10, x); }
double exp(double x) { return exp2(x * 1.4426950408889634); }
SinCos sincos(double x) { return {std::sin(x), std::cos(x)}; }
double atan2(double y, double x) { return std::atan2(y, x); }

}  // namespace rovernet::math
