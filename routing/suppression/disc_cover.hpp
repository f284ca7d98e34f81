// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"

#include <span>

namespace rovernet {

/// Share [-] of the disc of `radius` [m] around the origin that no disc of the same radius around
/// one of `centres` [m] covers; heights are ignored. Exact except for rounding (1e-12).
///
/// The border of the uncovered part consists of arcs of the circles. By Green's theorem, A = 1/2
/// closed integral of (x dy - y dx), the area is the sum of the integrals over these arcs.
double uncovered_share(std::span<const Vec3> centres, double radius);

}  // namespace rovernet
