// SPDX-License-Identifier: MIT
#include "sim/complex_math.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <complex>

namespace complex_math_test {
using namespace rovernet;
using math::Complex;

namespace {

bool near(Complex a, Complex b, double relative = 1e-15) {
    return std::abs(a - b) <= relative * std::abs(b);
}

constexpr std::array<Complex, 12> numbers{{{1, 0},
                                           {-1, 0},
                                           {0, 1},
                                           {0, -1},
                                           {3, 4},
                                           {-3, 4},
                                           {-3, -4},
                                           {1e-8, -7e7},
                                           {-1e8, 1e-7},
                                           {-1e8, -1e-7},
                                           {5.24, -0.3},
                                           {-1e-9, 1e-20}}};

}  // namespace

TEST_CASE("complex: the square root lies in the right half plane, and its square is the number") {
    for (const Complex z : numbers) {
        CAPTURE(z);
        const Complex root = math::square_root(z);
        CHECK(near(root * root, z));
        CHECK(root.real() >= 0);
        CHECK(std::signbit(root.imag()) == std::signbit(z.imag()));
        CHECK(near(root, std::sqrt(z)));
    }
    CHECK(math::square_root(0) == Complex{0});
}

TEST_CASE("complex: a quotient times its denominator is the numerator") {
    for (const Complex a : numbers) {
        for (const Complex b : numbers) CHECK(near(math::quotient(a, b) * b, a));
    }
}

TEST_CASE("complex: e^z agrees with the standard library, and is exactly 0 where it underflows") {
    for (const Complex z : {Complex{0, 0}, Complex{1, 2}, Complex{-30, 100}, Complex{-700, -3}}) {
        CHECK(near(math::exp(z), std::exp(z), 1e-14));
    }
    // What has vanished has no phase: that of a metre of metal is beyond the sine's range.
    CHECK(math::exp(Complex{-1e12, 1e12}) == Complex{0});
}

}  // namespace complex_math_test
