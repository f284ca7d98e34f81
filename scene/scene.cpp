// SPDX-License-Identifier: MIT
#include "scene/scene.hpp"

#include "scene/planning_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace rovernet {
namespace {

/// Gaps and pieces of wall up to this length [m] are none.
constexpr double shortest = 1e-9;

void check(const OccupancyGrid& grid, std::size_t materials) {
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
    if (!grid.cell_materials.empty() && grid.cell_materials.size() != grid.cells.size())
        refuse("there must be a material for each cell, or none");
    for (std::size_t i = 0; i < grid.cells.size(); ++i)
        if (grid.material_of(i) >= materials)
            refuse(fmt::format("there is no material number {}", grid.material_of(i)));
    constexpr double most_turned = 1e9;  // what math::sincos takes
    if (!std::isfinite(grid.origin.x + grid.origin.y) || !(std::abs(grid.yaw) <= most_turned))
        refuse("origin [m] must be finite and yaw [rad] within 1e9");
}

std::array<Vec3, 4> corners_of(const CellRectangle& r, const MapFrame& frame) {
    const double left = r.column0, bottom = r.row0, right = r.column1, top = r.row1;
    return {frame.to_world({left, bottom}), frame.to_world({right, bottom}),
            frame.to_world({right, top}), frame.to_world({left, top})};
}

bool has_unknown(const OccupancyGrid& grid) {
    return std::find(grid.cells.begin(), grid.cells.end(), Cell::unknown) != grid.cells.end();
}

/// Materials of the walls of a map, in ascending order.
std::set<std::uint8_t> materials_of(const OccupancyGrid& grid) {
    std::set<std::uint8_t> found;
    for (std::size_t i = 0; i < grid.cells.size(); ++i)
        if (grid.cells[i] == Cell::occupied) found.insert(grid.material_of(i));
    return found;
}

/// A gap no wider than this [cells] does not end a wall: one that stands askew to the cells is
/// drawn in steps, and a ray leaves it at each.
constexpr double widest_step = 2;

bool comes_before(Vec3 a, Vec3 b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

/// Joins crossings of one material that overlap or touch; leaves them in order of entry.
void join(std::vector<Crossing>& crossings) {
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& p, const Crossing& q) {
        return std::tie(p.material, p.entry, p.exit) < std::tie(q.material, q.entry, q.exit);
    });
    std::size_t kept = 0;
    for (const Crossing& c : crossings) {
        Crossing* last = kept > 0 ? &crossings[kept - 1] : nullptr;
        if (last && last->material == c.material && c.entry - last->exit <= shortest) {
            if (c.exit <= last->exit) continue;
            last->exit = c.exit;
            last->length = last->exit - last->entry;
        } else {
            crossings[kept++] = c;
        }
    }
    crossings.resize(kept);
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& p, const Crossing& q) {
        return std::tie(p.entry, p.exit, p.material) < std::tie(q.entry, q.exit, q.material);
    });
}

/// Sum of what the walls take that a segment crosses [dB], see Scene::wall_loss.
/// @param crossings     in order along the segment
/// @param step          gap that does not end a wall [m]
/// @param thickness_at  drawn thickness at a point that far along the segment [m]
template <class ThicknessAt>
double loss_of_walls(std::span<const Crossing> crossings, const WallRates& rates, double step,
                     double enough, ThicknessAt thickness_at) {
    double sum = 0;
    for (auto part = crossings.begin(); part != crossings.end() && sum <= enough;) {
        const std::size_t material = part->material;
        double end = part->exit, inside = 0;
        bool heavy = false;
        for (; part != crossings.end() && part->material == material && part->entry - end <= step;
             ++part) {
            heavy = heavy || thickness_at((part->entry + part->exit) / 2) >= rates.thinnest_heavy;
            end = part->exit;
            inside += part->length;
        }
        const WallRate& rate = (heavy ? rates.heavy : rates.light)[material];
        sum += rate.per_crossing + rate.per_metre * inside;
    }
    return sum;
}

}  // namespace

Scene::Scene(OccupancyGrid grid, std::vector<Material> materials)
    : Scene(std::vector<OccupancyGrid>{std::move(grid)}, std::move(materials)) {}

Scene::Scene(std::vector<OccupancyGrid> maps, std::vector<Material> materials)
    : materials_(std::move(materials)) {
    if (materials_.empty()) materials_.push_back({});
    for (const OccupancyGrid& map : maps) check(map, materials_.size());
    std::erase_if(maps, [](const OccupancyGrid& map) { return map.columns == 0; });
    if (maps.empty()) return;
    std::vector<WallsOfMap> walls;
    for (std::size_t i = 0; i < maps.size(); ++i) {
        const std::size_t before = layers_.size();
        add_map(maps[i]);
        for (std::size_t k = before; k < layers_.size(); ++k) {
            const WallLayer& layer = layers_[k];
            walls.push_back({layer.frame, layer.walls, layer.material, layer.height, i});
        }
    }
    faces_ = std::make_shared<const Faces>(std::move(walls));
    grid_ = maps.size() == 1 ? std::move(maps.front()) : planning_grid(maps);
    frame_ = MapFrame(grid_);
    obstacle_cells_ = solid_rectangles(grid_, Solid::obstacles);
    plain_ = std::all_of(layers_.begin(), layers_.end(), [&](const WallLayer& layer) {
        return materials_[layer.material].follows_model() && !std::isfinite(layer.height);
    });
}

void Scene::add_map(const OccupancyGrid& grid) {
    const MapFrame frame(grid);
    const auto index = [&](const std::vector<CellRectangle>& rectangles) {
        return std::make_shared<const WallIndex>(grid.columns, grid.rows, rectangles);
    };
    const auto used = materials_of(grid);
    for (const std::uint8_t material : used) {
        const auto walls = solid_rectangles(grid, WallsOf{material});
        const auto indexed = index(walls);
        layers_.push_back({frame, walls, indexed,
                           std::make_shared<const WallThickness>(frame, indexed), material,
                           materials_[material].height.value});
    }
    const bool walls_are_all = used.size() == 1 && !has_unknown(grid);
    obstacles_.emplace_back(frame, walls_are_all ? layers_.back().walls
                                                 : index(solid_rectangles(grid, Solid::obstacles)));
    occupied_cells_ +=
        static_cast<std::size_t>(std::count(grid.cells.begin(), grid.cells.end(), Cell::occupied));
    bound(grid, frame);
}

/// Makes the box around the maps take in one more.
void Scene::bound(const OccupancyGrid& grid, const MapFrame& frame) {
    const double right = grid.columns, top = grid.rows;
    if (obstacles_.size() == 1) lower_left_ = upper_right_ = frame.to_world({0, 0});
    for (const CellPoint corner :
         {CellPoint{0, 0}, CellPoint{right, 0}, CellPoint{0, top}, CellPoint{right, top}}) {
        const Vec3 p = frame.to_world(corner);
        lower_left_ = {std::min(lower_left_.x, p.x), std::min(lower_left_.y, p.y), 0};
        upper_right_ = {std::max(upper_right_.x, p.x), std::max(upper_right_.y, p.y), 0};
    }
}

const WallLayer* Scene::only_layer() const {
    const bool is_one = layers_.size() == 1 && !std::isfinite(layers_.front().height);
    return is_one ? &layers_.front() : nullptr;
}

void Scene::crossings(Vec3 a, Vec3 b, std::vector<Crossing>& out) const {
    out.clear();
    if (layers_.empty() || a == b) return;
    if (const WallLayer* only = only_layer()) {
        only->crossings(only->frame.to_cells(a), only->frame.to_cells(b), distance(a, b), out);
    } else {
        merged_crossings(a, b, out);
    }
}

void Scene::merged_crossings(Vec3 a, Vec3 b, std::vector<Crossing>& out) const {
    const bool reversed = comes_before(b, a);
    if (reversed) std::swap(a, b);
    out.clear();
    for (const WallLayer& layer : layers_) layer.append_crossings(a, b, out);
    join(out);
    if (!reversed) return;
    const double length = distance(a, b);
    for (Crossing& c : out) c = {length - c.exit, length - c.entry, c.length, c.material};
    std::reverse(out.begin(), out.end());
}

std::vector<Crossing> Scene::crossings(Vec3 a, Vec3 b) const {
    std::vector<Crossing> out;
    crossings(a, b, out);
    return out;
}

double Scene::wall_length(Vec3 a, Vec3 b, double enough) const {
    if (layers_.empty() || a == b) return 0;
    if (const WallLayer* only = only_layer()) {
        return only->walls->solid_length(only->frame.to_cells(a), only->frame.to_cells(b),
                                         distance(a, b), enough);
    }
    if (comes_before(b, a)) std::swap(a, b);  // sums in one order
    double sum = 0;
    for (const Crossing& c : crossings(a, b)) sum += c.length;
    return sum;
}

double Scene::wall_loss(Vec3 a, Vec3 b, std::span<const WallRate> rates, double enough,
                        std::vector<Crossing>& scratch) const {
    if (comes_before(b, a)) std::swap(a, b);
    crossings(a, b, scratch);
    double sum = 0;
    for (const Crossing& c : scratch) {
        sum += rates[c.material].per_crossing + rates[c.material].per_metre * c.length;
        if (sum > enough) break;
    }
    return sum;
}

double Scene::wall_loss(Vec3 a, Vec3 b, const WallRates& rates, double enough,
                        std::vector<Crossing>& scratch) const {
    if (layers_.empty() || a == b) return 0;
    if (comes_before(b, a)) std::swap(a, b);
    const double step = widest_step * std::max(frame_.cell_width(), frame_.cell_height());
    const double length = distance(a, b);
    const WallLayer* only = only_layer();
    if (!only) {
        merged_crossings(a, b, scratch);
        return loss_of_walls(scratch, rates, step, enough, [&](double middle) {
            return wall_thickness(a + middle / length * (b - a));
        });
    }
    const CellPoint from = only->frame.to_cells(a), to = only->frame.to_cells(b);
    const double u = (to.u - from.u) / length, v = (to.v - from.v) / length;
    only->crossings(from, to, length, scratch);
    return loss_of_walls(scratch, rates, step, enough, [&](double middle) {
        return Meters{only->thickness->at({from.u + middle * u, from.v + middle * v})};
    });
}

Meters Scene::wall_thickness(Vec3 p) const {
    double most = 0;
    for (const WallLayer& layer : layers_) {
        most = std::max(most, layer.thickness->at(layer.frame.to_cells(p)));
    }
    return {most};
}

bool Scene::occupied(Vec3 p) const {
    return std::any_of(layers_.begin(), layers_.end(), [&](const WallLayer& layer) {
        return layer.walls->holds(layer.frame.to_cells(p));
    });
}

bool Scene::inside_map(Vec3 p) const {
    if (open_field()) return true;
    const CellPoint c = frame_.to_cells(p);
    return c.u >= 0 && c.u <= grid_.columns && c.v >= 0 && c.v <= grid_.rows;
}

double Scene::clearance(Vec3 p) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Obstacles& map : obstacles_) nearest = std::min(nearest, map.clearance(p));
    return nearest;
}

bool Scene::passable(Vec3 a, Vec3 b, Meters radius) const {
    return std::all_of(obstacles_.begin(), obstacles_.end(),
                       [&](const Obstacles& map) { return map.passable(a, b, radius); });
}

std::vector<WallRectangle> Scene::wall_rectangles() const {
    std::vector<WallRectangle> all;
    for (const WallLayer& layer : layers_)
        for (const CellRectangle& r : layer.rectangles)
            all.push_back({corners_of(r, layer.frame), layer.material});
    return all;
}

std::vector<OccupancyGrid> Scene::maps() const {
    if (obstacles_.size() == 1) return {grid_};
    std::vector<OccupancyGrid> all;
    for (const WallLayer& layer : layers_) {
        OccupancyGrid map = layer.frame.map(layer.walls->columns(), layer.walls->rows());
        map.material = static_cast<std::uint8_t>(layer.material);
        for (std::size_t i = 0; i < map.cells.size(); ++i) {
            const auto columns = static_cast<std::size_t>(map.columns);
            const bool is_wall =
                layer.walls->solid(static_cast<int>(i % columns), static_cast<int>(i / columns));
            if (is_wall) map.cells[i] = Cell::occupied;
        }
        all.push_back(std::move(map));
    }
    return all;
}

Scene Scene::with_walls_of(const Scene& other) const {
    Scene out = *this;
    out.materials_ = other.materials_;
    out.layers_ = other.layers_;
    out.plain_ = other.plain_;
    out.occupied_cells_ = other.occupied_cells_;
    return out;
}

}  // namespace rovernet
