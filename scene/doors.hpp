// SPDX-License-Identifier: MIT
#pragma once

#include "scene/materials/material.hpp"
#include "scene/scene_change.hpp"
#include "sim/geometry.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

// Doors: pieces of wall that exist only at some times. For each set of doors that are closed
// together a run has one scene; it changes scenes at run time.

namespace rovernet {

class Scene;

/// Door of a scene. A closed door is a wall for radio and an obstacle for robots; an open door has
/// no effect.
/// Example: examples/doors.cpp.
struct Door {
    /// Ends of the door's centre line [m]; z selects the storey.
    Vec3 from, to;
    /// Thickness of the door [m], > 0.
    Meters thickness{0.05};
    /// Material of the closed door.
    Material material = {};
    /// Times since the start of the run [ns] at which the door closes and opens; it is open at
    /// first. No time may be in both lists.
    std::vector<Duration> closes = {}, opens = {};

    /// Whether the door is closed at `t`; a change takes effect at its own instant.
    bool is_closed(Time t) const;
    /// Corners of the door in plan [m], counter-clockwise.
    std::array<Vec3, 4> corners() const;
};

/// Scene with walls in place of the closed doors; materials that it lacks are appended.
/// @param closed  closed doors, each within the maps
Scene with_closed(const Scene& open, std::span<const Door> closed);

/// Scene changes caused by doors that close and open, in ascending order of time; one for each time
/// at which the set of closed doors changes. Equal sets share a scene.
/// @param open  scene without its doors; not null
std::vector<SceneChange> scene_changes(const std::shared_ptr<const Scene>& open,
                                       std::span<const Door> doors);

}  // namespace rovernet
