// SPDX-License-Identifier: MIT
#include "scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace rovernet {
namespace {

/// Distances are compared with a radius this generously [m]: touching is allowed.
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

/// From the point to the segment a-b.
double squared_distance(Vec3 p, Vec3 a, Vec3 b) {
    const Vec3 along = b - a;
    const double squared_length = dot(along, along);
    const double t = squared_length > 0 ? dot(p - a, along) / squared_length : 0;
    return squared_distance(p, a + std::clamp(t, 0.0, 1.0) * along);
}

/// From the segment a-b to a box that it does not enter: the nearest pair has a corner of one.
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

/// The tile of a coordinate [m], or the nearest one.
int tile_of(double x, double tile_side, int tiles) {
    return static_cast<int>(std::clamp(std::floor(x / tile_side), 0.0, tiles - 1.0));
}

/// The part of a-b with low <= y <= high, as the range of its x; a.y <= b.y.
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

void check(const OccupancyGrid& grid) {
    const auto refuse = [](const std::string& what) {
        throw std::invalid_argument("Scene: " + what);
    };
    if (grid.columns < 0 || grid.rows < 0 || (grid.columns == 0) != (grid.rows == 0))
        refuse(fmt::format("columns and rows must both be > 0 (or both 0), got {} and {}",
                           grid.columns, grid.rows));
    if (grid.cells.size() !=
        static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows))
        refuse(fmt::format("there must be columns * rows cells, got {}", grid.cells.size()));
    for (const double side : {grid.cell_width, grid.cell_height})
        if (!(side > 0 && std::isfinite(side)))
            refuse(fmt::format("a cell's sides must be > 0 m, got {} m", side));
    if (!std::isfinite(grid.origin.x + grid.origin.y + grid.yaw))
        refuse("origin [m] and yaw [rad] must be finite");
}

}  // namespace

Scene::Scene(OccupancyGrid grid) : grid_(std::move(grid)) {
    check(grid_);
    if (open_field()) return;
    frame_ = MapFrame(grid_);
    walls_ = WallIndex(grid_.columns, grid_.rows, solid_rectangles(grid_, Solid::walls));
    obstacles_ = solid_rectangles(grid_, Solid::obstacles);
    const auto count = [&](Cell kind) {
        return std::count(grid_.cells.begin(), grid_.cells.end(), kind);
    };
    if (count(Cell::unknown) > 0) obstacle_index_.emplace(grid_.columns, grid_.rows, obstacles_);
    occupied_cells_ = static_cast<std::size_t>(count(Cell::occupied));
    lower_left_ = upper_right_ = frame_.to_world({0, 0});
    for (const CellPoint corner :
         {CellPoint{grid_.columns + 0.0, 0}, CellPoint{0, grid_.rows + 0.0},
          CellPoint{grid_.columns + 0.0, grid_.rows + 0.0}}) {
        const Vec3 p = frame_.to_world(corner);
        lower_left_ = {std::min(lower_left_.x, p.x), std::min(lower_left_.y, p.y), 0};
        upper_right_ = {std::max(upper_right_.x, p.x), std::max(upper_right_.y, p.y), 0};
    }
}

void Scene::crossings(Vec3 a, Vec3 b, std::vector<Crossing>& out) const {
    out.clear();
    if (walls_.empty() || a == b) return;
    walls_.crossings(frame_.to_cells(a), frame_.to_cells(b), distance(a, b), out);
}

std::vector<Crossing> Scene::crossings(Vec3 a, Vec3 b) const {
    std::vector<Crossing> out;
    crossings(a, b, out);
    return out;
}

double Scene::wall_length(Vec3 a, Vec3 b, double enough) const {
    if (walls_.empty() || a == b) return 0;
    return walls_.solid_length(frame_.to_cells(a), frame_.to_cells(b), distance(a, b), enough);
}

bool Scene::occupied(Vec3 p) const {
    const CellPoint c = frame_.to_cells(p);
    return c.u >= 0 && c.u < grid_.columns && c.v >= 0 && c.v < grid_.rows &&
           grid_.at(static_cast<int>(c.u), static_cast<int>(c.v)) == Cell::occupied;
}

bool Scene::inside_map(Vec3 p) const {
    if (open_field()) return true;
    const CellPoint c = frame_.to_cells(p);
    return c.u >= 0 && c.u <= grid_.columns && c.v >= 0 && c.v <= grid_.rows;
}

double Scene::clearance(Vec3 p) const {
    const WallIndex& index = obstacle_index();
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

bool Scene::passable(Vec3 a, Vec3 b, Meters radius) const {
    const WallIndex& index = obstacle_index();
    if (index.empty()) return true;
    CellPoint from = frame_.to_cells(a);
    CellPoint to = frame_.to_cells(b);
    if (std::pair(to.u, to.v) < std::pair(from.u, from.v)) std::swap(from, to);
    if (index.solid_length(from, to, 1, 0) > 0) return false;
    const double reach = radius.value - touching;
    return reach <= 0 ||
           !near_obstacle(index, frame_, on_map(from, frame_), on_map(to, frame_), reach);
}

std::vector<std::array<Vec3, 4>> Scene::wall_rectangles() const {
    std::vector<std::array<Vec3, 4>> corners;
    for (const CellRectangle& r : solid_rectangles(grid_, Solid::walls)) {
        const double left = r.column0, bottom = r.row0, right = r.column1, top = r.row1;
        corners.push_back({frame_.to_world({left, bottom}), frame_.to_world({right, bottom}),
                           frame_.to_world({right, top}), frame_.to_world({left, top})});
    }
    return corners;
}

}  // namespace rovernet
