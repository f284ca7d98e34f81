// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"

#include <optional>

// Times at which two robots on straight paths enter and leave a range. These times make link
// changes exact for propagation models that depend on distance.

namespace rovernet {

/// Time interval in which a point on a straight motion is within a range.
struct Passage {
    /// Time of entering the range [s].
    double enter;
    /// Time of leaving the range [s], > enter.
    double leave;
};

/// Interval in which |r + v t| < R, for relative position r [m] and velocity v [m/s]; empty if this
/// is never or always true, or if the path only touches the sphere of radius R [m].
///
/// The ends are roots of a quadratic, computed without cancellation: the discriminant and the
/// constant term are summed in double-double precision, and the smaller root is computed from the
/// product of the roots. Lengths and speeds may have any size. Empty if a number is not finite.
std::optional<Passage> range_crossing(Vec3 r, Vec3 v, double R);

}  // namespace rovernet
