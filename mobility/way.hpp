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
    Way(const Way& other) : left_(other.left_ ? std::make_unique<Left>(*other.left_) : nullptr) {}
    Way(Way&&) = default;
    Way& operator=(Way other) {
        left_ = std::move(other.left_);
        return *this;
    }
    /// Plans from where the mover is; nothing if there is no way.
    /// @throws std::invalid_argument unless `to` is finite
    static std::optional<Way> plan(Mover& mover, Vec3 to);

    /// The leg to the next corner, at `speed` > 0; nothing at the end of the way.
    std::optional<Leg> next_leg(const Mover& mover, MetersPerSecond speed);
    /// The next leg of the way, at the speed of the leg before.
    std::optional<Leg> next_leg(const Mover& mover) {
        return left_ ? next_leg(mover, left_->speed) : std::nullopt;
    }
    /// Rest of the way from where the mover is [m].
    double length_left(const Mover& mover) const;

  private:
    struct Left {
        std::vector<Vec3> corners;   // the next one last; one at least
        MetersPerSecond speed = {};  // speed of the last leg
    };
    std::unique_ptr<Left> left_;  // rest of the way; null: nothing
};

}  // namespace rovernet
