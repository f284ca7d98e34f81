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

// Doors: pieces of wall that exist only while they are closed. A run has one scene for each set of
// doors that are closed at the same time, and changes from scene to scene.

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
    /// Times since the start of the run [ns] at which the door closes and opens. The door is open
    /// at first. No time may be in both lists.
    std::vector<Duration> closes = {}, opens = {};

    /// Whether the door is closed at time `t`. At the time of a change the new state is valid.
    bool is_closed(Time t) const;
    /// Corners of the door in the horizontal plane [m], counter-clockwise.
    std::array<Vec3, 4> corners() const;
};

/// Copy of the scene `open` with walls in place of the closed doors. Materials of doors that the
/// scene lacks are appended to its materials.
/// @param closed  closed doors, each within the maps
Scene with_closed(const Scene& open, std::span<const Door> closed);

/// Scene changes caused by doors that close and open, in ascending order of time: one for each time
/// at which the set of closed doors changes. Equal sets of closed doors share a scene.
/// @param open  scene in which all doors are open; not null
std::vector<SceneChange> scene_changes(const std::shared_ptr<const Scene>& open,
                                       std::span<const Door> doors);

}  // namespace rovernet
