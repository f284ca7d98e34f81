// SPDX-License-Identifier: MIT
#pragma once

#include "sim/units.hpp"

#include <cstddef>
#include <vector>

namespace rovernet {

/// A link as a disc sees it.
struct DiscLink {
    double distance;  ///< [m]
    bool up;
};

/// The disc that decides a set of links best.
struct DiscFit {
    Meters range;
    std::size_t called_up;  ///< of the links, the nearest
    std::size_t wrong;      ///< down ones among them, and up ones beyond
};

/// Fits the range of a disc: the one with the fewest wrong decisions. Of several that are equally
/// good it is the lower median, in the order of how many links they call up. The range lies between
/// the distances of the farthest link that is called up and the next one, at their geometric mean;
/// it is half the nearest distance if no link is called up, and the farthest one if all are.
/// @param links  in any order; those of equal distance keep theirs
/// @throws std::invalid_argument without a link, or if a distance is not > 0 and finite
DiscFit fit_disc(std::vector<DiscLink> links);

}  // namespace rovernet
