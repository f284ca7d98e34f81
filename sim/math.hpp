// SPDX-License-Identifier: MIT
#pragma once

// Elementary functions with reproducible results. The C library's log, exp, sin and others differ
// in the last bit between versions and machines, and a last bit may decide whether a frame is
// received.

/// Elementary functions with the same bits from every compiler and C library, for decisions and
/// printed results. The functions are built from + - * / and bit operations, which IEEE 754 rounds
/// in one way only; compile with -ffp-contract=off and in the default rounding mode. The square
/// root needs no function here: IEEE 754 defines it. Usage: math::log10(x).
namespace rovernet::math {

/// Natural logarithm; error below 1 ulp. log2 and log10 are as accurate, and exact if the result is
/// an integer (log2(8), log10(1000)).
///
/// 0 gives -infinity, negative arguments and NaN give NaN, infinity gives infinity. Subnormal
/// arguments are as accurate as normal ones.
double log(double x);
/// Logarithm to base 2; see log() for accuracy and special values.
double log2(double x);
/// Logarithm to base 10; see log() for accuracy and special values.
double log10(double x);
/// log(1 + x), accurate for small x; error below 1 ulp, +-0 for +-0. -1 gives -infinity,
/// less than -1 and NaN give NaN, infinity gives infinity.
double log1p(double x);

/// 2^x; error below 1 ulp, exact for integers. Overflow gives infinity; underflow gives subnormal
/// numbers, then 0; NaN gives NaN.
double exp2(double x);
/// e^x; error below 1 ulp, exact for 0. Overflow, underflow and NaN as for exp2.
double exp(double x);
/// 10^x; error below 1.1 ulp, exact for 0 ... 22. Overflow, underflow and NaN as for exp2.
double exp10(double x);
/// e^x - 1, accurate for small x; error below 1.3 ulp, +-0 for +-0. Overflow gives
/// infinity, NaN gives NaN.
double expm1(double x);

/// Complementary error function, 2 / sqrt(pi) times the integral of e^(-t^2) from x to infinity.
/// Error below 6 ulp; for subnormal results (x > 26.5) below 6 times the smallest positive double.
/// NaN gives NaN.
double erfc(double x);

/// Sine and cosine of an angle, each with an error below 1 ulp.
struct SinCos {
    double sin;
    double cos;
};
/// Sine and cosine of x [rad], |x| <= 1e9; exactly sin(-x) = -sin(x) and cos(-x) = cos(x). Sine and
/// cosine are NaN for larger |x| (where neighbouring doubles are 1e-7 rad apart), for infinity and
/// for NaN.
SinCos sincos(double x);

/// Angle of the vector (x, y) [rad], -pi ... pi with the sign of y, counter-clockwise from the x
/// axis; 0 for the zero vector. Error below 1.6 ulp, exact (the nearest double) for multiples of an
/// eighth of a turn. NaN gives NaN.
double atan2(double y, double x);

}  // namespace rovernet::math
