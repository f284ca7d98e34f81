// SPDX-License-Identifier: MIT
#pragma once

#include "sim/time.hpp"

// Settings of next_link_change().

namespace rovernet {

/// Precision with which link changes are looked for: [links] of a scenario. Both bounds are for
/// models whose changes cannot be computed; the others are exact to the nanosecond.
struct LinkSearch {
    /// Error [ns] of the time of a change behind walls, >= 1 ns.
    Duration tolerance{1'000'000};
    /// Duration [ns] below which states of a link may be missed, for models of unknown shape; >= 1
    /// ns. Halving it doubles the looks.
    Duration min_dwell{100'000'000};
};

}  // namespace rovernet
