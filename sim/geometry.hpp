// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace rovernet {

/// A point or a vector in metres [m] (or metres per second, for velocities).
struct Vec3 {
    double x = 0;
    double y = 0;
    double z = 0;
    friend constexpr bool operator==(Vec3, Vec3) = default;
};

constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator*(double s, Vec3 v) { return {s * v.x, s * v.y, s * v.z}; }
constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Squared distance [m^2]; the same bits from a to b as from b to a.
constexpr double squared_distance(Vec3 a, Vec3 b) { return dot(a - b, a - b); }
/// Distance [m]; the same bits from a to b as from b to a.
inline double distance(Vec3 a, Vec3 b) { return std::sqrt(squared_distance(a, b)); }

}  // namespace rovernet
