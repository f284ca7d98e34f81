// SPDX-License-Identifier: MIT
#pragma once

#include "sim/math.hpp"

#include <cmath>
#include <complex>

// Complex functions with the same bits on every machine. Sums and products of std::complex are the
// same bits everywhere. Quotient, square root, std::abs, std::exp and std::polar of std::complex
// depend on the compiler and the C library; the functions below replace these functions.

namespace rovernet::math {

using Complex = std::complex<double>;

/// Quotient a / b, for |b|^2 neither 0 nor beyond the range of a double.
inline Complex quotient(Complex a, Complex b) { return a * std::conj(b) / std::norm(b); }

/// Phasor e^(j angle), angle in [rad], |angle| <= 1e9.
inline Complex phasor(double angle) {
    const auto [sine, cosine] = sincos(angle);
    return {cosine, sine};
}

/// Exponential e^z, for |Im z| <= 1e9 [rad]; exactly 0 for every imaginary part if e^Re(z) is 0.
inline Complex exp(Complex z) {
    const double size = exp(z.real());
    return size == 0 ? Complex{} : size * phasor(z.imag());
}

/// Square root with a real part >= 0 and the sign of z's imaginary part; 0 for 0. |z|^2 must be
/// within the range of a double.
inline Complex square_root(Complex z) {
    const double large = std::sqrt((std::sqrt(std::norm(z)) + std::abs(z.real())) / 2);
    if (large == 0) return 0;
    const double small = z.imag() / (2 * large);
    if (z.real() >= 0) return {large, small};
    return {std::abs(small), std::copysign(large, z.imag())};
}

}  // namespace rovernet::math
