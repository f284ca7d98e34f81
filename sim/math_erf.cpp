// SPDX-License-Identifier: MIT
#include "sim/math.hpp"
#include "sim/polynomial.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace rovernet::math {
namespace {

// (erf x / x - 2 / sqrt(pi)) / x^2 in x^2, for |x| <= 1/2; Chebyshev, error 4e-19.
constexpr std::array<double, 9> erf_tail{
    -0x1.812746b0379e7p-2,  0x1.ce2f21a042bcfp-4,   -0x1.b82ce31286cbcp-6,
    0x1.565bcd0d2ff6ep-8,   -0x1.c02db335c071dp-11, 0x1.f9a2dd9e25187p-14,
    -0x1.f4c2b861c2c9cp-17, 0x1.b7f36af42c55ep-20,  -0x1.3d8e8315e4ddcp-23};
constexpr double two_over_sqrt_pi = 0x1.20dd750429b6dp+0;

// (1 + 2 x) e^(x^2) erfc x in (x - 15/4) / (x + 15/4), for 1/2 <= x <= 27.5; minimax, error 9e-18
// of the function. Method: M. Shepherd and J. Laframboise, Chebyshev approximation of (1 + 2x)
// exp(x^2) erfc x, Mathematics of Computation 36 (1981) 249.
constexpr double middle = 3.75;
constexpr std::array<double, 21> scaled_erfc{
    0x1.3ccda0b5d5dc2p+0,  -0x1.1f367683f899fp-3,  0x1.d5f294815b953p-9,   0x1.510169d096061p-4,
    -0x1.bda9309a2c1d8p-4, 0x1.7a14188aac165p-4,   -0x1.e0d0fa6d4a4fdp-5,  0x1.d0b00378bc45fp-6,
    -0x1.3f603c59396e3p-7, 0x1.cc3a1131b417bp-10,  0x1.33fb48b5eaeeap-12,  -0x1.303fe4bf71cfap-12,
    0x1.b13ec49c324e2p-15, 0x1.779a6947f2466p-16,  -0x1.7fc310da3808bp-17, -0x1.078109216e314p-20,
    0x1.d241a69905cc2p-20, -0x1.878b03fe80b73p-25, -0x1.01555243a1cd3p-22, 0x1.d4dc080c48f0bp-27,
    0x1.a26b4c13b555ap-26};

// Function for x >= 1/2: e^(-x^2) by the square of the upper half of x, which is exact, and what is
// left.
double erfc_tail(double x) {
    constexpr double underflow = 27.3;
    if (x > underflow) return 0;
    const auto upper_bits = ~std::uint64_t{0x7ffffff};  // 26 bits
    const double hi = std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & upper_bits);
    const double left = (hi - x) * (hi + x);                             // > -3e-5
    const double growth = left * (1 + left * (0.5 + left * (1.0 / 6)));  // e^left - 1
    const double scaled = polynomial(scaled_erfc, (x - middle) / (x + middle)) / (1 + 2 * x);
    return exp(-hi * hi) * (scaled + scaled * growth);
}

}  // namespace

double erfc(double x) {
    const double size = std::abs(x);
    if (size < 0.5) {
        const double z = x * x;
        return 1 - x * (two_over_sqrt_pi + z * polynomial(erf_tail, z));
    }
    return x > 0 ? erfc_tail(size) : 2 - erfc_tail(size);
}

}  // namespace rovernet::math
