// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "sim/random.hpp"

#include <cstdint>

namespace rovernet {

/// Sequence of random numbers for one movement.
///
/// They depend only on seed, replication, the robot's name and the number of its movement, not on
/// other robots.
struct Draws {
    std::uint32_t used = 0;  // number of draws so far; 2^32 are enough for a billion legs

    double uniform(const Mover& mover) { return rovernet::uniform(mover.key(used++)); }
    double normal(const Mover& mover) { return rovernet::normal(mover.key(used++)); }
};

}  // namespace rovernet
