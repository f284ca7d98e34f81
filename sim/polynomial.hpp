// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

// Evaluation of polynomials, used by the approximations of sim/math.hpp.

namespace rovernet::math {

/// Value of the polynomial c[0] + c[1] x + c[2] x^2 + ..., with an odd number of coefficients.
/// Every compiler gives the same rounding.
///
/// Even and odd terms are summed separately, as polynomials in x^2: two short chains of
/// multiplications instead of the long one of Horner's rule, so the latency is half. Used by
/// math.cpp and by the error rates of models/phy.
///
///   polynomial(std::array{1.0, 2.0, 3.0}, x) == 1 + 2 x + 3 x^2
///
/// @param c  coefficients, lowest power first
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

}  // namespace rovernet::math
