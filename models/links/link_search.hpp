// SPDX-License-Identifier: MIT
#pragma once

#include "sim/time.hpp"

// Settings of next_link_change().

namespace rovernet {

/// Precision of the search for link changes: keys of [links] in a scenario file. Both values are
/// for propagation models whose link changes cannot be computed as roots; for other models the
/// changes are exact to the nanosecond.
struct LinkSearch {
    /// Largest error [ns], >= 1 ns, of the time of a link change that walls cause.
    Duration tolerance{1'000'000};
    /// Sampling interval [ns], >= 1 ns, for propagation models that do not state how their loss
    /// depends on the distance (LossShape::unknown). Shorter link states may be missed.
    Duration min_dwell{100'000'000};
};

}  // namespace rovernet
