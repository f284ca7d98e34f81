// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/coverage.hpp"
#include "sim/geometry.hpp"
#include "sim/units.hpp"

#include <vector>

namespace rovernet {

/// How a contour is traced.
struct ContourOptions {
    Meters farthest{1000};   ///< [m] > 0; where the level is still above, the contour ends there
    Meters resolution{0.1};  ///< [m] > 0; what is smaller need not be seen: half a pixel, say
};

/// Within which places around a transmitter its level is at least `level`: a closed polygon at the
/// antenna's height, counter-clockwise, first point not repeated; empty if there is no such place.
///
/// Traced by rays. Along each, the radius where the level falls below is bisected: exact to a
/// quarter of `resolution` where the level never rises along a ray, as with all listed models;
/// with another, some radius where it falls. There are 720 rays at least, and 4 `resolution`
/// between neighbours at most (at the distance `farthest`, up to 6000 rays); where the radius jumps
/// between neighbours, rays are put in until they are one `resolution` apart, so that a shadow has
/// its true edges. A shadow of less than 4 `resolution` can be missed.
/// @throws std::invalid_argument if an option is out of its range
std::vector<Vec3> contour(const Transmitter& transmitter, Dbm level, const ContourOptions& options);

}  // namespace rovernet
