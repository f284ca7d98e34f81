// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/map/coverage.hpp"
#include "sim/geometry.hpp"
#include "sim/units.hpp"

#include <vector>

namespace rovernet {

/// Contour line: a line of constant level on a coverage map.
struct ContourLine {
    /// Points of the line [m] at the map's height; levels are higher on the left side of the line.
    std::vector<Vec3> points;
    bool closed = false;  ///< whether the last point joins the first, which is not repeated
};

/// Smoothed borders of the area of a map where the level is at least `level`. Areas and gaps
/// narrower than about 1.3 `smoothing` vanish, such as streaks behind the ragged edge of a drawn
/// wall. Corners are rounded by about the same length. Islands smaller than a disc of radius
/// 2 `smoothing`, or narrower than `smoothing`, are omitted. Straight edges and contours of free
/// space do not move.
///
/// Method: the difference to `level`, clamped to +-0.5 dB, is smoothed by a Gaussian. The lines are
/// its zeros, found by marching squares (the planar case of W. E. Lorensen and H. E. Cline,
/// Computer Graphics 21(4), 1987). Lines that leave the map end half a cell beyond its edge.
/// @param smoothing  standard deviation of the Gaussian [m], > 0
/// @throws std::invalid_argument if smoothing is not > 0
std::vector<ContourLine> contours(const CoverageMap& map, Dbm level, Meters smoothing);

}  // namespace rovernet
