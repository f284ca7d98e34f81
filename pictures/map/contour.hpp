// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/map/coverage.hpp"
#include "sim/geometry.hpp"
#include "sim/units.hpp"

#include <vector>

namespace rovernet {

/// A line along which the level of a map is the same.
struct ContourLine {
    std::vector<Vec3> points;  ///< [m] at the map's height; places above the level to the left
    bool closed = false;       ///< the first point, which is not repeated, follows the last
};

/// The lines between the places of a map whose level is at least `level` and the others, smoothed:
/// areas and gaps that are narrower than about 1.3 `smoothing` vanish, such as the rays of light
/// and shadow behind the ragged edge of a drawn wall; corners are rounded by about as much, and
/// islands smaller than a disc of the radius 2 `smoothing` or narrower than it are left out.
/// Straight edges stay in their place, and so does a contour of free space.
///
/// Each level counts as how far it is above `level`, at most half a decibel either way; this is
/// smoothed by a Gaussian, whose zeros the lines go through (marching squares, W. E. Lorensen and
/// H. E. Cline, Computer Graphics 21(4), 1987, in the plane). Lines that leave the map go on to
/// half a cell beyond its edge.
/// @param smoothing  [m] > 0, standard deviation of the Gaussian
/// @throws std::invalid_argument if smoothing is not > 0
std::vector<ContourLine> contours(const CoverageMap& map, Dbm level, Meters smoothing);

}  // namespace rovernet
