// SPDX-License-Identifier: MIT
#pragma once

#include "sim/random.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace rovernet::test {

using Limits = std::numeric_limits<double>;
static_assert(std::numeric_limits<long double>::digits >= 64, "the oracle needs 11 bits to spare");

constexpr int samples = 100'000;

/// Distance of `value` from `exact` in units of the last place of `exact`.
inline double error_ulp(double value, long double exact) {
    const int exponent = std::max(std::ilogb(static_cast<double>(exact)), Limits::min_exponent - 1);
    return static_cast<double>(std::abs(value - exact) /
                               std::ldexp(1.0L, exponent - (Limits::digits - 1)));
}

inline double sample(int i, double from, double to) {
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

inline bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Hash of the bits of f(x) for many arguments x.
template <class Function>
std::uint64_t fingerprint(Function f, double from, double to) {
    std::uint64_t sum = 0;
    for (int i = 0; i < samples; ++i) {
        sum = combine(sum, std::bit_cast<std::uint64_t>(f(sample(i, from, to))));
    }
    return sum;
}

}  // namespace rovernet::test
