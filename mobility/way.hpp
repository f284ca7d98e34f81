// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace rovernet {

/// A planned way around the walls, walked corner by corner. Takes a pointer's size once its last
/// corner is headed for.
class Way {
  public:
    Way() = default;
    Way(const Way& other)
        : corners_(other.corners_ ? std::make_unique<std::vector<Vec3>>(*other.corners_)
                                  : nullptr) {}
    Way(Way&&) = default;
    Way& operator=(Way other) {
        corners_ = std::move(other.corners_);
        return *this;
    }
    /// Plans from where the mover is; nothing if there is no way.
    /// @throws std::invalid_argument unless `to` is finite
    static std::optional<Way> plan(Mover& mover, Vec3 to);

    /// The leg to the next corner, at `speed` > 0; nothing at the end of the way.
    std::optional<Leg> next_leg(const Mover& mover, MetersPerSecond speed);
    /// What is left of the way from where the mover is [m].
    double length_left(const Mover& mover) const;

  private:
    std::unique_ptr<std::vector<Vec3>> corners_;  // still to come, the next one last; null: none
};

}  // namespace rovernet
