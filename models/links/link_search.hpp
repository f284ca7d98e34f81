// SPDX-License-Identifier: MIT
#pragma once

#include "sim/time.hpp"

// Settings of next_link_change().

namespace rovernet {

/// Precision of the search for link changes: keys of [links] in a scenario file. Both values are
/// for models whose changes cannot be computed; other models are exact to the nanosecond.
struct LinkSearch {
    /// Largest error [ns] of the time of a link change by walls, >= 1 ns.
    Duration tolerance{1'000'000};
    /// Time [ns], >= 1 ns: a link that is up or down for less may be missed if the propagation
    /// model is sampled, because it does not state how its loss depends on the distance
    /// (LossShape).
    Duration min_dwell{100'000'000};
};

}  // namespace rovernet
