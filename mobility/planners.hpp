// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/planner.hpp"
#include "scene/scene.hpp"
#include "sim/units.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace rovernet {

/// Path planners of one scene, one for each storey and robot radius, created on first use.
///
/// Stairs are not part of a scene: a path between storeys is a straight line between any two
/// points, if Scene::passable allows it. Results do not depend on earlier calls: runs in one scene
/// may share its planners, one run after the other.
class Planners {
  public:
    /// The scene must outlive the planners.
    explicit Planners(const Scene& scene) : scene_(&scene) {}

    const Scene& scene() const { return *scene_; }
    /// Corners of the path [m], including both ends; empty if there is no path. See Planner.
    std::optional<std::vector<Vec3>> shortest_path(Vec3 from, Vec3 to, Meters radius) {
        if (is_level(from, to)) return planner(from.z, radius).shortest_path(from, to);
        if (!has_stairs(from, to, radius)) return std::nullopt;
        return std::vector{from, to};
    }
    /// Whether there is a path between two positions; the path itself is not searched for.
    bool has_way(Vec3 from, Vec3 to, Meters radius) {
        return is_level(from, to) ? planner(from.z, radius).has_way(from, to)
                                  : has_stairs(from, to, radius);
    }
    /// Number of searches for paths around obstacles.
    std::uint64_t searches() const {
        std::uint64_t sum = 0;
        for (const auto& [key, planner] : planners_) sum += planner.searches();
        return sum;
    }
    /// Whether both positions are on one storey.
    bool is_level(Vec3 from, Vec3 to) const {
        return scene_->storeys().number_at(from.z) == scene_->storeys().number_at(to.z);
    }

  private:
    Planner& planner(double z, Meters radius) {
        const std::size_t storey = scene_->storeys().number_at(z);
        return planners_.try_emplace({storey, radius}, scene_->storey(storey), radius)
            .first->second;
    }
    bool has_stairs(Vec3 from, Vec3 to, Meters radius) const {
        return scene_->inside_map(from) && scene_->inside_map(to) &&
               scene_->passable(from, to, radius);
    }

    const Scene* scene_;
    // Keys: number of the storey, radius of the robot.
    std::map<std::pair<std::size_t, Meters>, Planner> planners_;
};

}  // namespace rovernet
