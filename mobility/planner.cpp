// SPDX-License-Identifier: MIT
#include "mobility/planner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace rovernet {
namespace {

CellPoint centre(int column, int row) { return {column + 0.5, row + 0.5}; }

/// Ways between an end of the path and the centres of free cells around it, ring by ring until
/// enough are found; nearest first.
PathEnd joined_to_cells(const Scene& scene, Meters radius, const std::vector<std::uint8_t>& free,
                        Vec3 end) {
    constexpr std::size_t enough = 8, most = 16;
    const OccupancyGrid& grid = scene.grid();
    const CellNorm norm(scene.frame());
    const CellPoint p = scene.frame().to_cells(end);
    const int column = std::min(static_cast<int>(p.u), grid.columns - 1);
    const int row = std::min(static_cast<int>(p.v), grid.rows - 1);
    const double rings = radius.value / std::min(grid.cell_width, grid.cell_height) + 2;
    const int last_ring =
        static_cast<int>(std::min(rings, std::max(grid.columns, grid.rows) + 0.0));
    std::vector<PathEnd::Access> ways;
    for (int k = 0; k <= last_ring && ways.size() < enough; ++k)
        for (int j = std::max(row - k, 0); j <= std::min(row + k, grid.rows - 1); ++j)
            for (int i = std::max(column - k, 0); i <= std::min(column + k, grid.columns - 1);
                 ++i) {
                const int cell = j * grid.columns + i;
                if (std::max(std::abs(i - column), std::abs(j - row)) == k &&
                    free[static_cast<std::size_t>(cell)] &&
                    scene.passable(end, scene.frame().to_world(centre(i, j)), radius))
                    ways.push_back({cell, norm(p, centre(i, j))});
            }
    std::sort(ways.begin(), ways.end(), [](const auto& a, const auto& b) {
        return std::pair(a.length, a.cell) < std::pair(b.length, b.cell);
    });
    if (ways.size() > most) ways.resize(most);
    return {p, std::move(ways)};
}

/// Some cell of the one lies in the same part of the map as some cell of the other.
bool joined(const PathEnd& from, const PathEnd& to, const std::vector<std::int32_t>& part) {
    const auto part_of = [&](const PathEnd::Access& way) {
        return part[static_cast<std::size_t>(way.cell)];
    };
    return std::any_of(from.ways.begin(), from.ways.end(), [&](const auto& a) {
        return std::any_of(to.ways.begin(), to.ways.end(),
                           [&](const auto& b) { return part_of(a) == part_of(b); });
    });
}

using Path = std::vector<Vec3>;

double length_of(const Path& path) {
    double sum = 0;
    for (std::size_t i = 1; i < path.size(); ++i) sum += distance(path[i - 1], path[i]);
    return sum;
}

/// The same way with points no farther apart than `spacing` [m].
Path subdivided(const Path& path, double spacing) {
    Path points{path.front()};
    for (std::size_t i = 1; i < path.size(); ++i) {
        const Vec3 start = path[i - 1], along = path[i] - path[i - 1];
        const int parts = static_cast<int>(distance(path[i - 1], path[i]) / spacing) + 1;
        for (int k = 1; k < parts; ++k) points.push_back(start + (1.0 * k / parts) * along);
        points.push_back(path[i]);
    }
    return points;
}

/// From each corner straight to a far point in sight: the farthest that doubling jumps find.
Path straightened(const Scene& scene, Meters radius, const Path& path) {
    Path corners{path.front()};
    for (std::size_t anchor = 0; anchor + 1 < path.size();) {
        const auto sees = [&](std::size_t i) {
            return i < path.size() && scene.passable(path[anchor], path[i], radius);
        };
        std::size_t next = anchor + 1;
        std::size_t jump = 1;
        for (; sees(next + jump); jump *= 2) next += jump;
        for (; jump > 0; jump /= 2)
            if (sees(next + jump)) next += jump;
        corners.push_back(path[next]);
        anchor = next;
    }
    return corners;
}

bool passable(const Scene& scene, Meters radius, const Path& path) {
    for (std::size_t i = 1; i < path.size(); ++i)
        if (!scene.passable(path[i - 1], path[i], radius)) return false;
    return true;
}

/// Straightened from the start, then, its points a cell apart, from the goal.
Path pulled_tight(const Scene& scene, Meters radius, const Path& cells) {
    const double spacing = std::max(scene.frame().cell_width(), scene.frame().cell_height());
    const Path forward = straightened(scene, radius, cells);
    Path points = subdivided(forward, spacing);
    std::reverse(points.begin(), points.end());
    Path both = straightened(scene, radius, points);
    std::reverse(both.begin(), both.end());
    // Rounded points between passable ones may miss the radius by a hair.
    const bool better = length_of(both) < length_of(forward) && passable(scene, radius, both);
    return better ? both : forward;
}

Meters checked(Meters radius) {
    if (radius.value >= 0 && std::isfinite(radius.value)) return radius;
    throw std::invalid_argument(
        fmt::format("Planner: radius must be >= 0 m, got {} m", radius.value));
}

}  // namespace

Planner::Planner(const Scene& scene, Meters radius)
    : scene_(&scene),
      radius_(checked(radius)),
      space_(scene, radius),
      search_(scene.frame(), scene.grid().columns) {}

std::optional<std::vector<Vec3>> Planner::shortest_path(Vec3 from, Vec3 to) {
    const Scene& scene = *scene_;
    if (!scene.inside_map(from) || !scene.inside_map(to)) return std::nullopt;
    if (scene.passable(from, to, radius_)) return Path{from, to};
    const PathEnd start = joined_to_cells(scene, radius_, space_.free, from);
    const PathEnd goal = joined_to_cells(scene, radius_, space_.free, to);
    if (!joined(start, goal, space_.part)) return std::nullopt;

    const std::vector<int> cells = search_.shortest_way(space_.steps, start, goal);
    if (cells.empty()) return std::nullopt;
    const int columns = scene.grid().columns;
    Path path{from};
    for (const int cell : cells)
        path.push_back(scene.frame().to_world(centre(cell % columns, cell / columns), from.z));
    path.push_back(to);
    return pulled_tight(scene, radius_, path);
}

std::optional<std::vector<Vec3>> shortest_path(const Scene& scene, Vec3 from, Vec3 to,
                                               Meters radius) {
    return Planner(scene, radius).shortest_path(from, to);
}

}  // namespace rovernet
