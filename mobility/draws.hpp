// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "sim/random.hpp"

#include <cstdint>

namespace rovernet {

/// The random numbers of one movement, one after the other.
///
/// They depend on seed, replication, the robot's name and the number of its movement, and on
/// nothing that other robots do.
struct Draws {
    std::uint32_t used = 0;  // a leg takes a few: enough for a billion legs

    double uniform(const Mover& mover) { return rovernet::uniform(mover.key(used++)); }
    double normal(const Mover& mover) { return rovernet::normal(mover.key(used++)); }
};

}  // namespace rovernet
