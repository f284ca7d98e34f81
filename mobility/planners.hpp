// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/planner.hpp"
#include "scene/scene.hpp"
#include "sim/units.hpp"

#include <map>

namespace rovernet {

/// The planners of one scene, one for each radius of robot, made when first asked for.
///
/// A planner's answers do not depend on what it was asked before: runs in one scene may share its
/// planners, one run after the other.
class Planners {
  public:
    /// The scene must outlive the planners.
    explicit Planners(const Scene& scene) : scene_(&scene) {}

    const Scene& scene() const { return *scene_; }
    Planner& of_radius(Meters radius) {
        return by_radius_.try_emplace(radius, *scene_, radius).first->second;
    }

  private:
    const Scene* scene_;
    std::map<Meters, Planner> by_radius_;
};

}  // namespace rovernet
