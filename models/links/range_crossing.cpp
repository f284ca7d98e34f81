// SPDX-License-Identifier: MIT
#include "models/links/range_crossing.hpp"

#include <algorithm>
#include <cmath>

namespace rovernet {
namespace {

/// Number as the unevaluated sum of two doubles, with a relative precision of about 1e-31. Source:
/// T. J. Dekker, A floating-point technique for extending the available precision, Numerische
/// Mathematik 18, 1971.
struct Doubled {
    double high;
    double low = 0;
};

Doubled two_sum(double a, double b) {
    const double sum = a + b, rest = sum - a;
    return {sum, (a - (sum - rest)) + (b - rest)};
}

Doubled product(double a, double b) {
    constexpr double splitter = 134217729;  // 2^27 + 1
    const double a_top = splitter * a - (splitter * a - a), a_rest = a - a_top;
    const double b_top = splitter * b - (splitter * b - b), b_rest = b - b_top;
    const double high = a * b;
    return {high, ((a_top * b_top - high) + a_top * b_rest + a_rest * b_top) + a_rest * b_rest};
}

Doubled operator+(Doubled p, Doubled q) {
    const Doubled sum = two_sum(p.high, q.high);
    return two_sum(sum.high, sum.low + (p.low + q.low));
}

Doubled operator-(Doubled p, Doubled q) { return p + Doubled{-q.high, -q.low}; }

Doubled operator*(Doubled p, Doubled q) {
    const Doubled high = product(p.high, q.high);
    return two_sum(high.high, high.low + (p.high * q.low + p.low * q.high));
}

Doubled exact_dot(Vec3 p, Vec3 q) {
    return product(p.x, q.x) + product(p.y, q.y) + product(p.z, q.z);
}

/// Squared magnitude of the cross product: |p x q|^2.
Doubled squared_cross(Vec3 p, Vec3 q) {
    const Doubled x = product(p.y, q.z) - product(p.z, q.y);
    const Doubled y = product(p.z, q.x) - product(p.x, q.z);
    const Doubled z = product(p.x, q.y) - product(p.y, q.x);
    return x * x + y * y + z * z;
}

double largest(Vec3 p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

/// Vector p 2^-exponent.
Vec3 scaled(Vec3 p, int exponent) {
    return {std::ldexp(p.x, -exponent), std::ldexp(p.y, -exponent), std::ldexp(p.z, -exponent)};
}

}  // namespace

std::optional<Passage> range_crossing(Vec3 r, Vec3 v, double R) {
    const double length = std::max(largest(r), R), speed = largest(v);
    if (!(R > 0 && speed > 0 && std::isfinite(length) && std::isfinite(speed))) return std::nullopt;
    // All numbers are scaled to near 1, so that no square exceeds the range of a double.
    const int metre = std::ilogb(length), metre_per_second = std::ilogb(speed);
    const Vec3 p = scaled(r, metre), w = scaled(v, metre_per_second);
    const double range = std::ldexp(R, -metre);

    const Doubled speed2 = exact_dot(w, w), range2 = product(range, range);
    const double half_chord2 = (range2 * speed2 - squared_cross(p, w)).high;
    if (!(half_chord2 > 0)) return std::nullopt;
    const double b = -exact_dot(p, w).high;
    const double q = b + std::copysign(std::sqrt(half_chord2), b);
    const double one = std::ldexp(q / speed2.high, metre - metre_per_second);
    const double other = std::ldexp((exact_dot(p, p) - range2).high / q, metre - metre_per_second);
    const auto [enter, leave] = std::minmax(one, other);
    if (!(enter < leave)) return std::nullopt;
    return Passage{enter, leave};
}

}  // namespace rovernet
