// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/cell_search.hpp"
#include "scene/free_space.hpp"
#include "scene/scene.hpp"
#include "sim/geometry.hpp"
#include "sim/units.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace rovernet {

/// Finds ways around walls for round robots of one radius.
///
/// A* over the cells whose centres keep the radius from every obstacle (8 neighbours, no corner is
/// cut), then pulled tight by line of sight. Start and goal join the cells near them by any
/// straight line that is passable, so they may lie where no cell centre is free. Near the shortest
/// way, not the shortest: corners stand about a cell off. Every part of a path is Scene::passable.
/// A path depends on its two ends alone, not on what was asked before: see CellSearch for ties. The
/// last paths are kept, so ways between places of a list are searched once.
class Planner {
  public:
    /// Prepares the free cells once. The scene must outlive the planner.
    /// @throws std::invalid_argument unless radius >= 0 [m]
    Planner(const Scene& scene, Meters radius);

    /// Corners of the way [m], both ends included; {from, to} if the straight line is passable.
    ///
    /// None if an end lies off the map or nearer to an obstacle than the radius, or if there is no
    /// way. Corners between the ends are at the height of `from`.
    std::optional<std::vector<Vec3>> shortest_path(Vec3 from, Vec3 to);
    /// Whether there is a way, without searching for it.
    bool has_way(Vec3 from, Vec3 to) const;

  private:
    /// Ends of a way around obstacles, in one part of the map.
    struct Ends {
        PathEnd start, goal;
    };
    std::optional<Ends> ends(Vec3 from, Vec3 to) const;
    std::optional<std::vector<Vec3>> path_around(Vec3 from, Vec3 to);

    /// The bits of a question's coordinates.
    using Question = std::array<std::uint64_t, 6>;

    const Scene* scene_;
    Meters radius_;
    FreeSpace space_;
    CellSearch search_;
    std::map<Question, std::optional<std::vector<Vec3>>> known_;  // ways around obstacles
};

/// Plans once; keep a Planner to plan often.
std::optional<std::vector<Vec3>> shortest_path(const Scene& scene, Vec3 from, Vec3 to,
                                               Meters radius);

}  // namespace rovernet
