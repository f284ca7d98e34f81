// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/map/coverage.hpp"
#include "sim/units.hpp"

#include <utility>
#include <vector>

namespace rovernet {

/// Level whose contour a picture of a coverage map shows.
struct ContourLevel {
    Dbm level;            ///< received power on the contour [dBm]
    const char* meaning;  ///< "sensitivity" or "range_db"
};

/// Contours of a transmitter's coverage: at the receivers' sensitivity, and at
/// RadioLabels::range_db if it is set and the propagation model gives levels. The model disc has
/// one contour, its range.
std::vector<ContourLevel> contour_levels(const Transmitter& transmitter);

/// Ends of the colour scale [dBm]: well below the weakest contour, and above the levels of all but
/// 0.05 % of the cells.
std::pair<double, double> color_range(const CoverageMap& map,
                                      const std::vector<ContourLevel>& levels);

}  // namespace rovernet
