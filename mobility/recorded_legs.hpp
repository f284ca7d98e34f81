// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace rovernet {

/// Motion as it was: the legs that a robot took, one after the other, whatever stands in its way
/// now. A leg that was given up early ends where the next one begins; between legs it rests.
class RecordedLegs {
  public:
    static constexpr AtDoors at_doors = AtDoors::passes;

    /// @param legs  by start, each later than the one before; the first one is where it begins
    /// @throws std::invalid_argument if they are in another order
    explicit RecordedLegs(std::vector<Leg> legs);

    Step next_leg(Mover& mover);

  private:
    std::shared_ptr<const std::vector<Leg>> legs_;
    std::size_t next_ = 0;  // leg that comes
};

}  // namespace rovernet
