// SPDX-License-Identifier: MIT
#pragma once

#include "scene/doors.hpp"
#include "scene/obstacles.hpp"
#include "sim/geometry.hpp"
#include "sim/units.hpp"

#include <optional>
#include <span>
#include <vector>

namespace rovernet {

/// Closed doors as obstacles for robots.
class ClosedDoors {
  public:
    /// @param scene  scene with the storeys of the doors
    ClosedDoors(const Scene& scene, std::span<const Door> doors);

    /// Whether a disc of the given radius [m] can move straight from a to b without entering a
    /// closed door; touching is allowed. If any part of the path is on a door's storey, the whole
    /// path is checked against that door.
    bool passable(Vec3 a, Vec3 b, Meters radius) const;
    /// Position on the straight path from a to b where a disc of the given radius [m] stops, a
    /// micrometre before it touches a closed door. The position is a if the disc cannot move at
    /// all. Empty if the whole path is free.
    std::optional<Vec3> stop(Vec3 a, Vec3 b, Meters radius) const;

  private:
    // Closed door as an obstacle, with the heights [m] of the bottom and top of the door's storey.
    struct Closed {
        Obstacles door;
        double bottom, top;
    };
    std::vector<Closed> doors_;
};

}  // namespace rovernet
