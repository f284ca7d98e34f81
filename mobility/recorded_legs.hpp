// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace rovernet {

/// Replay of a recorded motion: the legs (pieces of movement) of a robot in order, through any
/// obstacles of the present scene. A leg that was interrupted ends where the next leg begins;
/// between legs the robot rests.
class RecordedLegs {
  public:
    static constexpr AtDoors at_doors = AtDoors::passes;

    /// @param legs  in ascending order of start; the first one gives the start position
    /// @throws std::invalid_argument if the legs are in any other order
    explicit RecordedLegs(std::vector<Leg> legs);

    Step next_leg(Mover& mover);

  private:
    std::shared_ptr<const std::vector<Leg>> legs_;
    std::size_t next_ = 0;  // index of the next leg
};

}  // namespace rovernet
