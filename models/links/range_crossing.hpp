// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"

#include <optional>

namespace rovernet {

/// When something moving straight is within a range.
struct Passage {
    double enter;  ///< [s]
    double leave;  ///< [s], > enter
};

/// When |r + v t| < R, for relative position r [m] and velocity v [m/s]; none if never, always, or
/// if it only touches. The times are roots of a quadratic, found without cancellation: the
/// discriminant and the constant term are summed in doubled precision, and the smaller root comes
/// from the product of both. Lengths and speeds may have any size. None if a number is not finite.
std::optional<Passage> range_crossing(Vec3 r, Vec3 v, double R);

}  // namespace rovernet
