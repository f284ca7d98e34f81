// SPDX-License-Identifier: MIT
#include "sim/math.hpp"

#include "sim/polynomial.hpp"

#include <algorithm>
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

// log(2^exponent (1 + f)) + f_lo, for 1 + f in [sqrt 1/2, sqrt 2); ln(1 + f) = 2 atanh(f / (2 +
// f)), summed as f - f^2/2 + s (f^2/2 + s^2 tail) in two parts. Method: FreeBSD msun, k_log.h and
// e_log2.c.
double log_near_one(double f, double f_lo, double exponent, const LogBase& base) {
    const double s = f / (2 + f);
    const double half_square = 0.5 * f * f;
    const double z = s * s;
    const double rest = s * (half_square + z * polynomial(atanh_tail, z));
    const auto upper_half = std::uint64_t{0xffffffff00000000};  // 21 bits: hi * scale_hi is exact
    const double hi =
        std::bit_cast<double>(std::bit_cast<std::uint64_t>(f - half_square) & upper_half);
    const double lo = (f - hi) - half_square + rest + f_lo;

    const double whole = exponent * base.two_hi;
    const double part = hi * base.scale_hi;
    const double sum = whole + part;
    const double error = (whole - sum) + part;
    return sum +
           (error + (lo * base.scale_hi + (lo + hi) * base.scale_lo + exponent * base.two_lo));
}

// (log(1 + x) - x) / x^2, for |x| < 2^-8; error of the logarithm 6e-21.
constexpr std::array<double, 7> log1p_series{-1.0 / 2, 1.0 / 3, -1.0 / 4, 1.0 / 5,
                                             -1.0 / 6, 1.0 / 7, -1.0 / 8};

// x = 2^exponent (1 + f), for a positive finite x.
struct Mantissa {
    double f, exponent;
};
Mantissa split(double x) {
    const bool subnormal = x < std::numeric_limits<double>::min();
    const auto image = std::bit_cast<std::int64_t>(subnormal ? x * 0x1p54 : x);
    constexpr auto sqrt_half = std::int64_t{0x3fe6a09e667f3bcd};
    const std::int64_t e = (image - sqrt_half) >> 52;
    return {std::bit_cast<double>(image - (e << 52)) - 1,
            static_cast<double>(subnormal ? e - 54 : e)};
}

double scaled_log(double x, const LogBase& base) {
    if (!(x > 0)) return x == 0 ? -infinity : not_a_number;
    if (x == infinity) return infinity;
    const auto [f, exponent] = split(x);
    return log_near_one(f, 0, exponent, base);
}

struct PowerBase {
    double limit;            // overflow or underflow beyond
    double log2;             // of the base
    double two_hi, two_lo;   // the logarithm of 2 to this base; hi has 40 bits
    double slope, slope_lo;  // ln(base)
    std::array<double, 11> curve;
};
// curve: (base^r - 1 - slope r) / r^2 for base^|r| <= sqrt 2; minimax, error 2e-19 of base^r.
constexpr PowerBase power_of_e{
    .limit = 750,
    .log2 = 0x1.71547652b82fep+0,
    .two_hi = base_e.two_hi,
    .two_lo = base_e.two_lo,
    .slope = 1,
    .slope_lo = 0,
    .curve = {0x1p-1, 0x1.5555555555557p-3, 0x1.5555555555556p-5, 0x1.11111111100cep-7,
              0x1.6c16c16c162ccp-10, 0x1.a01a01abef415p-13, 0x1.a01a01a6dcaffp-16,
              0x1.71de021a90822p-19, 0x1.27e4db57442fbp-22, 0x1.af4e196027428p-26,
              0x1.1f731ea5352cap-29}};
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

// x = n log(2) + r + r_lo, with n the integer nearest to x log2(base): base^x = 2^n base^(r +
// r_lo).
struct Reduced {
    double n, r, r_lo;
};
Reduced reduce(const PowerBase& base, double x) {
    constexpr double round = 0x1.8p52;  // adding it leaves no bits for a fraction
    const double n = (x * base.log2 + round) - round;
    const double r_hi = x - n * base.two_hi;
    const double r = r_hi - n * base.two_lo;
    return {n, r, (r_hi - r) - n * base.two_lo};
}

double power(const PowerBase& base, double x) {
    if (!(std::abs(x) < base.limit)) return x > 0 ? infinity : x < 0 ? 0 : not_a_number;
    const auto [n, r, r_lo] = reduce(base, x);
    const double line = r * base.slope;
    const double sum = 1 + line;
    const double error = (1 - sum) + line;
    const double rest = r * r * polynomial(base.curve, r) + (r * base.slope_lo + r_lo * base.slope);
    const double y = sum + (error + rest);

    const int exponent = static_cast<int>(n);
    const int half = exponent / 2;  // in two steps, as 2^n may overflow or be subnormal alone
    return y * power_of_two(half) * power_of_two(exponent - half);
}

// A number in two parts, hi + lo.
struct TwoParts {
    double hi, lo;
};

// The sum without an error. D. Knuth, The Art of Computer Programming, vol. 2, 4.2.2, theorem B.
TwoParts exact_sum(double a, double b) {
    const double sum = a + b;
    const double b_part = sum - a;
    return {sum, (a - (sum - b_part)) + (b - b_part)};
}

// pi / 2; the first four parts have 23 bits, so that their multiples up to 2^30 are exact.
constexpr std::array<double, 5> quarter_turn{0x1.921fb4p+0, 0x1.4442dp-24, 0x1.846988p-48,
                                             0x1.8cc514p-72, 0x1.80dc1cd129025p-95};

// x - n pi / 2, below 2^-60 of itself off. Method: W. Cody and W. Waite, Software Manual for the
// Elementary Functions, 1980, chapter 8.
TwoParts turned_back(double x, double n) {
    double hi = x;
    double lo = 0;
    for (const double part : quarter_turn) {
        const TwoParts rest = exact_sum(hi, -(n * part));
        hi = rest.hi;
        lo += rest.lo;
    }
    const double sum = hi + lo;
    return {sum, (hi - sum) + lo};
}

// (sin r - r) / r^3 and (cos r - 1 + r^2 / 2) / r^4 in r^2, for |r| <= pi / 4; minimax, error of
// the functions 6e-18.
constexpr std::array<double, 7> sin_tail{
    -0x1.5555555555555p-3,  0x1.111111111111p-7,   -0x1.a01a01a019937p-13, 0x1.71de3a54607a5p-19,
    -0x1.ae64541295cdfp-26, 0x1.61217ee5cca1bp-33, -0x1.ab17bdcbd3414p-41};
constexpr std::array<double, 7> cos_tail{
    0x1.5555555555555p-5,  -0x1.6c16c16c16c16p-10, 0x1.a01a01a019d0ap-16, -0x1.27e4fb7712ca2p-22,
    0x1.1eed8deb82809p-29, -0x1.9394b9eb4d56dp-37, 0x1.ab78473be59d7p-45};

SinCos first_octant(TwoParts r) {
    const double z = r.hi * r.hi;
    const double half = 0.5 * z;
    const double sin_rest = r.hi * (z * polynomial(sin_tail, z)) + r.lo * (1 - half);
    const double line = 1 - half;
    const double cos_rest = ((1 - line) - half) + (z * (z * polynomial(cos_tail, z)) - r.hi * r.lo);
    return {r.hi + sin_rest, line + cos_rest};
}

// Angles of the slopes 0, 1/8 ... 1.
constexpr std::array<TwoParts, 9> eighths{{{0, 0},
                                           {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
                                           {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                                           {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
                                           {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                           {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
                                           {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                                           {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
                                           {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}}};
constexpr TwoParts half_turn{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
constexpr TwoParts right_angle{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

// (atan s - s) / s^3 in s^2, for |s| <= 1/16; minimax, error of the function 6e-19.
constexpr std::array<double, 5> atan_tail{-0x1.5555555555553p-2, 0x1.999999998a25ep-3,
                                          -0x1.249248a94e1b2p-3, 0x1.c719c125bffb4p-4,
                                          -0x1.714b378610818p-4};

// The angle of slope b / a, for 0 <= b <= a, 2^-900 < a < 2^1000: the nearest eighth's angle, and
// that of s = (b - c a) / (a + c b) more.
TwoParts angle_of_slope(double b, double a) {
    const auto nearest = static_cast<std::size_t>(8 * (b / a) + 0.5);
    const double c = 0.125 * static_cast<double>(nearest);
    const auto upper_bits = ~std::uint64_t{0x7ffffff};  // 26 bits: c a_hi and c a_lo are exact
    const double a_hi = std::bit_cast<double>(std::bit_cast<std::uint64_t>(a) & upper_bits);
    const double s = ((b - c * a_hi) - c * (a - a_hi)) / (a + c * b);
    const double z = s * s;
    const TwoParts angle = exact_sum(eighths[nearest].hi, s);
    return {angle.hi, angle.lo + (eighths[nearest].lo + s * z * polynomial(atan_tail, z))};
}

// Angle of from + sign * angle.
double turned(TwoParts from, double sign, TwoParts angle) {
    const TwoParts sum = exact_sum(from.hi, sign * angle.hi);
    return sum.hi + (sum.lo + (from.lo + sign * angle.lo));
}

// The angle of (x, y) from the x axis, for finite x, y >= 0 that are not both 0.
double angle_from_axis(double y, double x, bool behind) {
    const bool steep = y > x;
    double a = steep ? y : x;
    double b = steep ? x : y;
    const double scale = a > 0x1p900 ? 0x1p-200 : a < 0x1p-800 ? 0x1p300 : 1;
    a *= scale;
    b *= scale;
    const TwoParts angle = angle_of_slope(b, a);
    if (steep) return turned(right_angle, behind ? 1 : -1, angle);
    return behind ? turned(half_turn, -1, angle) : angle.hi + angle.lo;
}

}  // namespace

double log(double x) { return scaled_log(x, base_e); }
double log2(double x) { return scaled_log(x, base_2); }
double log10(double x) { return scaled_log(x, base_10); }
double exp2(double x) { return power(power_of_2, x); }
double exp10(double x) { return power(power_of_10, x); }
double exp(double x) { return power(power_of_e, x); }

double log1p(double x) {
    if (std::abs(x) < 0x1p-54) return x;
    if (std::abs(x) < 0x1p-8) return x + x * (x * polynomial(log1p_series, x));
    if (x > -0.25 && x < 0.375) return log_near_one(x, 0, 0, base_e);
    if (!(x > -1 && x < infinity)) return x == -1 ? -infinity : x > 0 ? infinity : not_a_number;
    const TwoParts sum = exact_sum(1, x);
    const auto [f, exponent] = split(sum.hi);
    return log_near_one(f, sum.lo / sum.hi, exponent, base_e);
}

double expm1(double x) {
    if (std::abs(x) < 0x1p-54) return x;
    if (std::abs(x) < 0.25) return x + x * x * polynomial(power_of_e.curve, x);
    if (!(x < 40)) return exp(x);  // 1 is less than a hundredth ulp of it
    if (x < -40) return -1;
    const auto [n, r, r_lo] = reduce(power_of_e, x);
    const double scale = power_of_two(static_cast<int>(n));
    const TwoParts whole = exact_sum(scale, -1);
    const TwoParts sum = exact_sum(whole.hi, scale * r);
    const double rest = r * r * polynomial(power_of_e.curve, r) + r_lo;
    return sum.hi + (sum.lo + (whole.lo + scale * rest));
}

SinCos sincos(double x) {
    constexpr double limit = 1e9;
    if (!(std::abs(x) <= limit)) return {not_a_number, not_a_number};
    if (std::abs(x) < 0x1p-27) return {x, 1};
    constexpr double round = 0x1.8p52;
    const double n = (x * 0x1.45f306dc9c883p-1 + round) - round;
    const SinCos r = first_octant(turned_back(x, n));
    switch (static_cast<std::int64_t>(n) & 3) {
        case 0: return r;
        case 1: return {r.cos, -r.sin};
        case 2: return {-r.sin, -r.cos};
        default: return {-r.cos, r.sin};
    }
}

double atan2(double y, double x) {
    if (std::isnan(x) || std::isnan(y)) return not_a_number;
    if (x == 0 && y == 0) return 0;
    double v = std::abs(y);
    double u = std::abs(x);
    if (std::max(u, v) == infinity) {  // only which of them is infinite counts
        v = v == infinity ? 1 : 0;
        u = u == infinity ? 1 : 0;
    }
    return std::copysign(angle_from_axis(v, u, x < 0), y);
}

}  // namespace rovernet::math
