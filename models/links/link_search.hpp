// SPDX-License-Identifier: MIT
#pragma once

#include "sim/time.hpp"

namespace rovernet {

/// [links] of a scenario.
struct LinkSearch {
    Duration tolerance{1'000'000};  ///< [ns] a change behind walls is known to this, >= 1 ns
    /// [ns] of models of unknown shape: shorter states are missed; >= 1 ns
    Duration min_dwell{100'000'000};
};

}  // namespace rovernet
