// SPDX-License-Identifier: MIT
#pragma once

#include "scene/materials/material.hpp"
#include "scene/obstacles.hpp"
#include "scene/scene.hpp"
#include "scene/scene_change.hpp"
#include "sim/geometry.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

// Doors: pieces of wall that are there at times only. A run has a scene for each set of doors that
// are closed at a time, and goes from one to the next.

namespace rovernet {

/// Door of a scene. While it is closed it is a wall for radio and an obstacle for robots; while it
/// is open it is nothing.
struct Door {
    /// Ends of its middle line [m]; z tells the storey.
    Vec3 from, to;
    /// Thickness [m], > 0.
    Meters thickness{0.05};
    /// What it is made of.
    Material material = {};
    /// Times at which it closes and opens, since the begin of the run [ns]; it is open at first. No
    /// time is in both.
    std::vector<Duration> closes = {}, opens = {};

    /// Whether it is closed at `t`: closing holds from its nanosecond on, and so does opening.
    bool is_closed(Time t) const;
    /// Corners in plan [m], counter-clockwise.
    std::array<Vec3, 4> corners() const;
};

/// Doors that are closed, as obstacles for robots.
class ClosedDoors {
  public:
    /// @param scene  whose storeys the doors are on
    ClosedDoors(const Scene& scene, std::span<const Door> doors);

    /// Whether a disc of that radius [m] can move straight from a to b; touching is allowed. A way
    /// that is partly on a door's storey is held against the door all along.
    bool passable(Vec3 a, Vec3 b, Meters radius) const;
    /// Place on the way from a to b where the disc stops, a micrometre before it touches a door; a
    /// if it cannot move at all; nothing if it can go all the way.
    std::optional<Vec3> stop(Vec3 a, Vec3 b, Meters radius) const;

  private:
    // Door, and the heights [m] between which its storey is.
    struct Closed {
        Obstacles door;
        double bottom, top;
    };
    std::vector<Closed> doors_;
};

/// Scene with walls where the doors are; materials that it does not have are added behind its own.
/// @param closed  doors, each within the maps
Scene with_closed(const Scene& open, std::span<const Door> closed);

/// Changes of a scene whose doors close and open, in ascending order of time; one for each time at
/// which another set of doors is closed than before. Equal sets share a scene.
/// @param open  scene without its doors; not null
std::vector<SceneChange> scene_changes(const std::shared_ptr<const Scene>& open,
                                       std::span<const Door> doors);

}  // namespace rovernet
