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

/// Interval of times t [s] at which a moving point is within a range: |r + v t| < R, with the
/// point's position r [m] at t = 0, its velocity v [m/s] and the range R [m]. Empty if the point is
/// never or always within the range, or if its path only touches the sphere of radius R.
///
/// The ends are roots of a quadratic, computed without cancellation. The discriminant and the
/// constant term are summed in double-double precision, and the smaller root is computed from the
/// product of the roots. Lengths and speeds may have any size. Empty if an argument is not finite.
std::optional<Passage> range_crossing(Vec3 r, Vec3 v, double R);

}  // namespace rovernet
