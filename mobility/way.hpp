// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace rovernet {

/// A planned way around the walls, walked corner by corner.
class Way {
  public:
    Way() = default;
    /// Plans from where the mover is; nothing if there is no way.
    /// @throws std::invalid_argument unless `to` is finite
    static std::optional<Way> plan(Mover& mover, Vec3 to);

    /// The leg to the next corner, at `speed` > 0; nothing at the end of the way.
    std::optional<Leg> next_leg(const Mover& mover, MetersPerSecond speed);
    /// What is left of the way from where the mover is [m].
    double length_left(const Mover& mover) const;

  private:
    std::vector<Vec3> corners_;
    std::size_t done_ = 0;  // corners reached
};

}  // namespace rovernet
