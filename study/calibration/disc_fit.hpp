// SPDX-License-Identifier: MIT
#pragma once

#include "sim/units.hpp"

#include <cstddef>
#include <vector>

namespace rovernet {

/// Link with its distance and state, for the fit of a disc model.
struct DiscLink {
    double distance;  ///< distance between the antennas [m]
    bool up;
};

/// Fitted disc model: the range with the fewest wrong decisions (link up or down).
struct DiscFit {
    Meters range;
    std::size_t wrong;  ///< wrong decisions: links that are down within the range, or up beyond it
};

/// Fits the range of a disc model to known links. The chosen range has the fewest links for which
/// the model's decision (up or down) is wrong. If several ranges are equally good, they are ordered
/// by the number of links within the range, and the lower median is chosen. The range is
/// - half the nearest distance, if no link is within the range
/// - the farthest distance, if all links are within the range
/// - otherwise the geometric mean of the distances of the farthest link within and the nearest
///   link beyond the range
/// @param links  links in any order; links of equal distance keep their order
/// @throws std::invalid_argument without a link, or if a distance is not > 0 and finite
DiscFit fit_disc(std::vector<DiscLink> links);

}  // namespace rovernet
