// SPDX-License-Identifier: MIT
#include "scene/obstacles.hpp"

#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace rovernet {
namespace {

/// Tolerance for comparing distances with a radius [m]: touching is allowed.
constexpr double touching = 1e-9;

/// A rectangle in the map's own axes [m].
struct Box {
    double x0, y0, x1, y1;
};

Box box_of(const CellRectangle& r, const MapFrame& frame) {
    return {r.column0 * frame.cell_width(), r.row0 * frame.cell_height(),
            r.column1 * frame.cell_width(), r.row1 * frame.cell_height()};
}

/// A point in the map's own axes [m].
Vec3 on_map(CellPoint p, const MapFrame& frame) {
    return {p.u * frame.cell_width(), p.v * frame.cell_height(), 0};
}

double squared_distance(Vec3 p, const Box& box) {
    const double dx = std::max({0.0, box.x0 - p.x, p.x - box.x1});
    const double dy = std::max({0.0, box.y0 - p.y, p.y - box.y1});
    return dx * dx + dy * dy;
}

/// Squared distance from the point to the segment a-b.
double squared_distance(Vec3 p, Vec3 a, Vec3 b) {
    const Vec3 along = b - a;
    const double squared_length = dot(along, along);
    const double t = squared_length > 0 ? dot(p - a, along) / squared_length : 0;
    return squared_distance(p, a + std::clamp(t, 0.0, 1.0) * along);
}

/// Squared distance from the segment a-b to a box that it does not enter: the nearest pair of
/// points includes a corner of one.
double squared_distance(Vec3 a, Vec3 b, const Box& box) {
    double nearest = std::min(squared_distance(a, box), squared_distance(b, box));
    for (const Vec3 corner :
         {Vec3{box.x0, box.y0}, Vec3{box.x1, box.y0}, Vec3{box.x1, box.y1}, Vec3{box.x0, box.y1}})
        nearest = std::min(nearest, squared_distance(corner, a, b));
    return nearest;
}

double nearest_in_tile(Vec3 p, std::span<const CellRectangle> tile, const MapFrame& frame) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const CellRectangle& r : tile)
        nearest = std::min(nearest, squared_distance(p, box_of(r, frame)));
    return nearest;
}

/// Tile of a coordinate [m]; the nearest tile for a coordinate outside.
int tile_of(double x, double tile_side, int tiles) {
    return static_cast<int>(std::clamp(std::floor(x / tile_side), 0.0, tiles - 1.0));
}

/// Part of a-b with low <= y <= high, as a range of x; a.y <= b.y.
std::pair<double, double> x_range(Vec3 a, Vec3 b, double low, double high) {
    const double slope = b.y > a.y ? (b.x - a.x) / (b.y - a.y) : 0;
    const double from = low > a.y && b.y > a.y ? a.x + (low - a.y) * slope : a.x;
    const double to = high < b.y ? a.x + (high - a.y) * slope : b.x;
    return std::minmax(from, to);
}

bool near_obstacle(const WallIndex& index, const MapFrame& frame, Vec3 a, Vec3 b, double radius) {
    if (b.y < a.y) std::swap(a, b);
    const double width = WallIndex::tile_size * frame.cell_width();
    const double height = WallIndex::tile_size * frame.cell_height();
    const int last_row = tile_of(b.y + radius, height, index.tile_rows());
    for (int row = tile_of(a.y - radius, height, index.tile_rows()); row <= last_row; ++row) {
        const auto [left, right] =
            x_range(a, b, row * height - radius, (row + 1) * height + radius);
        const int last = tile_of(right + radius, width, index.tile_columns());
        for (int i = tile_of(left - radius, width, index.tile_columns()); i <= last; ++i)
            for (const CellRectangle& r : index.tile(i, row))
                if (squared_distance(a, b, box_of(r, frame)) < radius * radius) return true;
    }
    return false;
}

/// Contact with a box at squared distance `squared` > 0 of p, in the map's own axes.
Contact contact_with(const Box& box, Vec3 p, double squared, double radius) {
    const double x = std::clamp(p.x, box.x0, box.x1) - p.x;
    const double y = std::clamp(p.y, box.y0, box.y1) - p.y;
    const bool is_corner = x != 0 && y != 0;
    const double share = is_corner ? std::min(radius / std::sqrt(squared), 1.0) : 1;
    return {math::atan2(y, x), math::atan2(share, std::sqrt(1 - share * share))};
}

}  // namespace

void Obstacles::add_contacts(Vec3 p, Meters radius, std::vector<Contact>& out) const {
    const WallIndex& index = *index_;
    if (index.empty()) return;
    const Vec3 q = on_map(frame_.to_cells(p), frame_);
    const double reach = radius.value + contact_gap;
    const double width = WallIndex::tile_size * frame_.cell_width();
    const double height = WallIndex::tile_size * frame_.cell_height();
    const int top = tile_of(q.y + reach, height, index.tile_rows());
    const int right = tile_of(q.x + reach, width, index.tile_columns());
    for (int j = tile_of(q.y - reach, height, index.tile_rows()); j <= top; ++j)
        for (int i = tile_of(q.x - reach, width, index.tile_columns()); i <= right; ++i)
            for (const CellRectangle& r : index.tile(i, j)) {
                const Box box = box_of(r, frame_);
                const double squared = squared_distance(q, box);
                if (squared == 0 || squared > reach * reach) continue;
                out.push_back(
                    contact_with(box, q, squared, std::max(radius.value - touching, 0.0)));
                out.back().towards += frame_.yaw();
            }
}

double Obstacles::clearance(Vec3 p) const {
    const WallIndex& index = *index_;
    if (index.empty()) return std::numeric_limits<double>::infinity();
    const Vec3 q = on_map(frame_.to_cells(p), frame_);
    const double width = WallIndex::tile_size * frame_.cell_width();
    const double height = WallIndex::tile_size * frame_.cell_height();
    const int column = tile_of(q.x, width, index.tile_columns());
    const int row = tile_of(q.y, height, index.tile_rows());
    double nearest = std::numeric_limits<double>::infinity();
    // Ring by ring: the tiles of ring k are at least k - 1 tiles away.
    for (int k = 0; k <= std::max(index.tile_columns(), index.tile_rows()); ++k) {
        const double ring = (k - 1) * std::min(width, height);
        if (ring > 0 && nearest <= ring * ring) break;
        const int top = std::min(row + k, index.tile_rows() - 1);
        const int right = std::min(column + k, index.tile_columns() - 1);
        for (int j = std::max(row - k, 0); j <= top; ++j) {
            const bool whole_row = j == row - k || j == row + k;
            for (int i = std::max(column - k, 0); i <= right; ++i)
                if (whole_row || i == column - k || i == column + k)
                    nearest = std::min(nearest, nearest_in_tile(q, index.tile(i, j), frame_));
        }
    }
    return std::sqrt(nearest);
}

bool Obstacles::passable(Vec3 a, Vec3 b, Meters radius) const {
    const WallIndex& index = *index_;
    if (index.empty()) return true;
    CellPoint from = frame_.to_cells(a);
    CellPoint to = frame_.to_cells(b);
    if (std::pair(to.u, to.v) < std::pair(from.u, from.v)) std::swap(from, to);
    if (index.solid_length(from, to, 1, 0) > 0) return false;
    const double reach = radius.value - touching;
    return reach <= 0 ||
           !near_obstacle(index, frame_, on_map(from, frame_), on_map(to, frame_), reach);
}

}  // namespace rovernet
