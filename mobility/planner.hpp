// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/cell_search.hpp"
#include "mobility/free_space.hpp"
#include "scene/scene.hpp"
#include "sim/geometry.hpp"
#include "sim/units.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace rovernet {

/// Path planner around walls, for round robots of one radius.
///
/// A path is found by A* over the cells whose centres are at least the radius away from every
/// obstacle (8 neighbours, no corner is cut). The path is then shortened along lines of sight.
/// Start and goal are connected to nearby cells by passable straight lines, so start and goal may
/// lie where no cell centre is free. If the map has no border, they may also lie beyond all cells,
/// and the path may lead there. The path is slightly longer than the shortest: its corners are
/// about a cell away from the walls. Every part of a path is Scene::passable. A path depends only
/// on its two ends, not on earlier calls: see CellSearch for ties. Recent paths are cached, so
/// paths between places of a list are searched once.
class Planner {
  public:
    /// Computes the cells in which the robot may stand, once. The scene must outlive the planner.
    /// @throws std::invalid_argument unless radius >= 0 [m]
    Planner(const Scene& scene, Meters radius);

    /// Corners of the path [m], including both ends; {from, to} if the straight line is passable.
    ///
    /// Empty if an end lies beyond the map's border or nearer to an obstacle than the radius, or if
    /// there is no path. Corners between the ends are at the height of `from`.
    std::optional<std::vector<Vec3>> shortest_path(Vec3 from, Vec3 to);
    /// Whether there is a path between two positions; the path itself is not searched for.
    bool has_way(Vec3 from, Vec3 to) const;
    /// Number of searches for paths around obstacles.
    std::uint64_t searches() const { return searches_; }

  private:
    /// Start and goal of a path around obstacles, both in one connected part of the map.
    struct Ends {
        PathEnd start, goal;
    };
    std::optional<Ends> ends(Vec3 from, Vec3 to) const;
    std::optional<std::vector<Vec3>> path_around(Vec3 from, Vec3 to);

    /// Key of a cached path: the bits of the coordinates of both ends.
    using Question = std::array<std::uint64_t, 6>;

    const Scene* scene_;
    Meters radius_;
    FreeSpace space_;
    CellSearch search_;
    std::uint64_t searches_ = 0;
    std::map<Question, std::optional<std::vector<Vec3>>> known_;  // cached paths around obstacles
};

/// Corners [m] of the path from `from` to `to` around the walls, for a robot with `radius`, see
/// Planner::shortest_path. For many paths, use one Planner.
std::optional<std::vector<Vec3>> shortest_path(const Scene& scene, Vec3 from, Vec3 to,
                                               Meters radius);

}  // namespace rovernet
