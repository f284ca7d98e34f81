// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

// Vectors and distances. A link has exactly the same length in both directions, so between equal
// radios both directions go up and down together.

namespace rovernet {

/// Point or vector in metres [m], or a velocity [m/s]. Axes of the scene: x to the right and y up
/// on a map, z up from the ground.
struct Vec3 {
    /// Coordinates [m]: x to the right, y up on the map, z above the ground.
    double x = 0;
    double y = 0;
    double z = 0;
    friend constexpr bool operator==(Vec3, Vec3) = default;
};

/// Sum, difference, multiple and scalar product, component by component. The library is compiled
/// without contraction to fused multiply-add, so that every compiler gives the same bits.
constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator*(double s, Vec3 v) { return {s * v.x, s * v.y, s * v.z}; }
constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Squared distance [m^2]; the same bits from a to b as from b to a. The result overflows only for
/// distances beyond 1e154 m.
constexpr double squared_distance(Vec3 a, Vec3 b) { return dot(a - b, a - b); }
/// Distance [m]; the same bits from a to b as from b to a, because IEEE 754 defines std::sqrt
/// exactly. squared_distance() is faster for comparisons.
inline double distance(Vec3 a, Vec3 b) { return std::sqrt(squared_distance(a, b)); }

}  // namespace rovernet
