// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"

#include <optional>

// When two robots that move straight are within a range of one another. It is what makes link
// changes of models that go by distance exact.

namespace rovernet {

/// Time during which something that moves straight is within a range.
struct Passage {
    /// Begin [s].
    double enter;
    /// End [s], > enter.
    double leave;
};

/// Time during which |r + v t| < R, for relative position r [m] and velocity v [m/s]; none if
/// never, always, or if it only touches.
///
/// The ends are roots of a quadratic, found without cancellation: the discriminant and the constant
/// term are summed in doubled precision, and the smaller root comes from the product of both.
/// Lengths and speeds may have any size. None if a number is not finite.
std::optional<Passage> range_crossing(Vec3 r, Vec3 v, double R);

}  // namespace rovernet
