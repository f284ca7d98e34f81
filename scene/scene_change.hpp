// SPDX-License-Identifier: MIT
#pragma once

#include "sim/time.hpp"

#include <algorithm>
#include <memory>
#include <span>

namespace rovernet {

class ClosedDoors;
class Scene;

/// Change of the scene during a run: from `time` on, a new Scene replaces the previous one. A Scene
/// itself never changes, so the scene is a function of time.
struct SceneChange {
    Time time;
    /// Scene that is used from the time of the change on; not null.
    std::shared_ptr<const Scene> scene;
    /// Closed doors of the scene, at which robots stop; null if no door is closed.
    std::shared_ptr<const ClosedDoors> doors;
};

/// Last scene change at or before `t`; null if there is none.
/// @param changes  in ascending order of time
inline const SceneChange* last_change(std::span<const SceneChange> changes, Time t) {
    const auto next =
        std::upper_bound(changes.begin(), changes.end(), t,
                         [](Time time, const SceneChange& change) { return time < change.time; });
    return next == changes.begin() ? nullptr : &*(next - 1);
}

/// Time of the first scene change after `t`; `never` if there is none.
/// @param changes  in ascending order of time
inline Time next_change(std::span<const SceneChange> changes, Time t) {
    const auto next =
        std::upper_bound(changes.begin(), changes.end(), t,
                         [](Time time, const SceneChange& change) { return time < change.time; });
    return next == changes.end() ? never : next->time;
}

}  // namespace rovernet
