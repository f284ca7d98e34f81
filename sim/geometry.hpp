// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

// Geometry of places. A link has the same length in both directions to the last bit, so that both
// directions are up or down together where radios are alike.

namespace rovernet {

/// Point or vector in metres [m], or a velocity [m/s]. The scene's axes: x to the right and y up on
/// a map, z up from the ground.
struct Vec3 {
    /// Coordinates [m]: to the right, up on the map, and above the ground.
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

/// Squared distance [m^2]; the same bits from a to b as from b to a, so that a link has one length
/// in both directions. It overflows for distances beyond 1e154 m only.
constexpr double squared_distance(Vec3 a, Vec3 b) { return dot(a - b, a - b); }
/// Distance [m]; the same bits from a to b as from b to a. std::sqrt is exact to the last bit, by
/// IEEE 754. Comparisons of distances are cheaper by squared_distance().
inline double distance(Vec3 a, Vec3 b) { return std::sqrt(squared_distance(a, b)); }

}  // namespace rovernet
