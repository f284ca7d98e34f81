// SPDX-License-Identifier: MIT
#include "mobility/planner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace rovernet {
namespace {

CellPoint centre(int column, int row) { return {column + 0.5, row + 0.5}; }

/// Straight connections between an end of the path and the centres of free cells around it, ring by
/// ring until enough are found; nearest first.
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

/// Whether cells of the two ends lie in the same connected part of the map.
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

/// Path with points at most `spacing` [m] apart.
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

/// Path that goes from each corner straight to a far visible point: the farthest found by doubling
/// jumps.
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

/// Path straightened from the start and then, with points a cell apart, from the goal.
Path pulled_tight(const Scene& scene, Meters radius, const Path& cells) {
    const double spacing = std::max(scene.frame().cell_width(), scene.frame().cell_height());
    const Path forward = straightened(scene, radius, cells);
    Path points = subdivided(forward, spacing);
    std::reverse(points.begin(), points.end());
    Path both = straightened(scene, radius, points);
    std::reverse(both.begin(), both.end());
    // Rounded points between passable ones may violate the radius minimally.
    const bool better = length_of(both) < length_of(forward) && passable(scene, radius, both);
    return better ? both : forward;
}

/// Numbers as bits: -0 differs from 0.
std::array<std::uint64_t, 6> bits_of(const std::array<double, 6>& numbers) {
    return std::bit_cast<std::array<std::uint64_t, 6>>(numbers);
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

/// Ends of a path around obstacles; empty if there is none.
std::optional<Planner::Ends> Planner::ends(Vec3 from, Vec3 to) const {
    Ends ends{joined_to_cells(*scene_, radius_, space_.free, from),
              joined_to_cells(*scene_, radius_, space_.free, to)};
    if (!joined(ends.start, ends.goal, space_.part)) return std::nullopt;
    return ends;
}

bool Planner::has_way(Vec3 from, Vec3 to) const {
    return scene_->inside_map(from) && scene_->inside_map(to) &&
           (scene_->passable(from, to, radius_) || ends(from, to));
}

std::optional<std::vector<Vec3>> Planner::shortest_path(Vec3 from, Vec3 to) {
    if (!scene_->inside_map(from) || !scene_->inside_map(to)) return std::nullopt;
    if (scene_->passable(from, to, radius_)) return Path{from, to};
    constexpr std::size_t most_known = 4096;
    const Question question = bits_of({from.x, from.y, from.z, to.x, to.y, to.z});
    if (const auto found = known_.find(question); found != known_.end()) return found->second;
    if (known_.size() == most_known) known_.clear();
    ++searches_;
    return known_.emplace(question, path_around(from, to)).first->second;
}

std::optional<std::vector<Vec3>> Planner::path_around(Vec3 from, Vec3 to) {
    const auto found = ends(from, to);
    if (!found) return std::nullopt;
    const int columns = scene_->grid().columns;
    Path path{from};
    for (const int cell : search_.shortest_way(space_.steps, found->start, found->goal))
        path.push_back(scene_->frame().to_world(centre(cell % columns, cell / columns), from.z));
    path.push_back(to);
    return pulled_tight(*scene_, radius_, path);
}

std::optional<std::vector<Vec3>> shortest_path(const Scene& scene, Vec3 from, Vec3 to,
                                               Meters radius) {
    return Planner(scene, radius).shortest_path(from, to);
}

}  // namespace rovernet
