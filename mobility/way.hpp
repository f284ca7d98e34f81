// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace rovernet {

/// Planned path around walls, followed corner by corner. A Way has the size of a pointer, and uses
/// no further memory while the robot moves to the last corner.
class Way {
  public:
    Way() = default;
    Way(const Way& other) : left_(other.left_ ? std::make_unique<Left>(*other.left_) : nullptr) {}
    Way(Way&&) = default;
    Way& operator=(Way other) {
        left_ = std::move(other.left_);
        return *this;
    }
    /// Plans a path from the mover's position; empty if there is no path.
    /// @throws std::invalid_argument unless `to` is finite
    static std::optional<Way> plan(Mover& mover, Vec3 to);

    /// Leg to the next corner of the path, at `speed` > 0; empty at the end of the path.
    std::optional<Leg> next_leg(const Mover& mover, MetersPerSecond speed);
    /// Leg to the next corner of the path, at the speed of the previous leg; empty at the end.
    std::optional<Leg> next_leg(const Mover& mover) {
        return left_ ? next_leg(mover, left_->speed) : std::nullopt;
    }
    /// Length of the rest of the path from the mover's position [m].
    double length_left(const Mover& mover) const;

  private:
    struct Left {
        std::vector<Vec3> corners;   // remaining corners in reverse order; at least one
        MetersPerSecond speed = {};  // speed of the last leg
    };
    std::unique_ptr<Left> left_;  // rest of the path; null: none
};

}  // namespace rovernet
