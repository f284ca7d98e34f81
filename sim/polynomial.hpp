// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

namespace rovernet::math {

/// c[0] + c[1] x + c[2] x^2 + ... with an odd number of coefficients, rounded in the same way by
/// every compiler. Even and odd terms apart: half the latency of Horner's rule.
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
