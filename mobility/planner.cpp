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

/// Connects an end of a path to cells by straight lines.
class Joining {
  public:
    Joining(const Scene& scene, Meters radius, const FreeSpace& space, Vec3 end)
        : scene_(scene), radius_(radius), space_(space), end_(end) {}

    PathEnd joined() {
        const double margin = space_.margin;
        const double right = space_.columns - margin, top = space_.rows - margin;
        if (at_.u < -margin) join_column(0);
        if (at_.u > right) join_column(space_.columns - 1);
        if (at_.v < -margin) join_row(0);
        if (at_.v > top) join_row(space_.rows - 1);
        if (ways_.empty()) join_cells_around();
        return {at_, std::move(ways_)};
    }

  private:
    /// Connects the end to a cell if the cell is free and the line is passable.
    void join(int column, int row) {
        const int cell = row * space_.columns + column;
        const CellPoint centre = space_.centre(cell);
        if (space_.free[static_cast<std::size_t>(cell)] &&
            scene_.passable(end_, scene_.frame().to_world(centre), radius_))
            ways_.push_back({cell, norm_(at_, centre)});
    }
    // Connect an end beyond the cells to cells of the outermost column or row on its side, evenly
    // spread. The path is pulled tight later.
    void join_column(int column) {
        spread(space_.rows, [&](int row) { join(column, row); });
    }
    void join_row(int row) {
        spread(space_.columns, [&](int column) { join(column, row); });
    }
    static void spread(int cells, auto take) {
        const int count = std::min(cells, 33);
        for (int k = 0; k < count; ++k)
            take(static_cast<int>(std::int64_t{k} * (cells - 1) / std::max(count - 1, 1)));
    }
    void join_cells_around();

    const Scene& scene_;
    Meters radius_;
    const FreeSpace& space_;
    Vec3 end_;
    CellNorm norm_{scene_.frame()};
    CellPoint at_ = scene_.frame().to_cells(end_);
    std::vector<PathEnd::Access> ways_;
};

/// Connects the end to free cells around it, ring by ring until enough are found; nearest first.
void Joining::join_cells_around() {
    constexpr std::size_t enough = 8, most = 16;
    const int columns = space_.columns, rows = space_.rows;
    const int column = std::min(static_cast<int>(at_.u + space_.margin), columns - 1);
    const int row = std::min(static_cast<int>(at_.v + space_.margin), rows - 1);
    const double rings = radius_.value / std::min(norm_.width, norm_.height) + 2;
    const int last_ring = static_cast<int>(std::min(rings, std::max(columns, rows) + 0.0));
    for (int k = 0; k <= last_ring && ways_.size() < enough; ++k)
        for (int j = std::max(row - k, 0); j <= std::min(row + k, rows - 1); ++j)
            for (int i = std::max(column - k, 0); i <= std::min(column + k, columns - 1); ++i)
                if (std::max(std::abs(i - column), std::abs(j - row)) == k) join(i, j);
    std::sort(ways_.begin(), ways_.end(), [](const auto& a, const auto& b) {
        return std::pair(a.length, a.cell) < std::pair(b.length, b.cell);
    });
    if (ways_.size() > most) ways_.resize(most);
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

/// Path with points at most `spacing` [m] apart; a line has at most `most_parts` parts.
Path subdivided(const Path& path, double spacing, int most_parts) {
    Path points{path.front()};
    for (std::size_t i = 1; i < path.size(); ++i) {
        const Vec3 start = path[i - 1], along = path[i] - path[i - 1];
        const double spaces = distance(path[i - 1], path[i]) / spacing;
        const int parts = static_cast<int>(std::min(spaces, most_parts + 0.0)) + 1;
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
    constexpr int enough = 1000;
    const int most_parts = std::max(scene.grid().columns + scene.grid().rows, enough);
    Path points = subdivided(forward, spacing, most_parts);
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
      search_(scene.frame(), space_.columns, space_.margin) {}

/// Ends of a path around obstacles; empty if there is none.
std::optional<Planner::Ends> Planner::ends(Vec3 from, Vec3 to) const {
    Ends ends{Joining(*scene_, radius_, space_, from).joined(),
              Joining(*scene_, radius_, space_, to).joined()};
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
    Path path{from};
    for (const int cell : search_.shortest_way(space_.steps, found->start, found->goal))
        path.push_back(scene_->frame().to_world(space_.centre(cell), from.z));
    path.push_back(to);
    return pulled_tight(*scene_, radius_, path);
}

std::optional<std::vector<Vec3>> shortest_path(const Scene& scene, Vec3 from, Vec3 to,
                                               Meters radius) {
    return Planner(scene, radius).shortest_path(from, to);
}

}  // namespace rovernet
