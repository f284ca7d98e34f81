// SPDX-License-Identifier: MIT
#include "scene/scene.hpp"

#include "scene/faces.hpp"
#include "scene/obstacles.hpp"
#include "scene/planning_grid.hpp"
#include "scene/rectangles.hpp"
#include "scene/wall_layer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace rovernet {
namespace {

constexpr double endless = WallLayer::endless;

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
        refuse("there must be one material for each cell, or no materials");
    for (std::size_t i = 0; i < grid.cells.size(); ++i)
        if (grid.material_of(i) >= materials)
            refuse(fmt::format("there is no material number {}", grid.material_of(i)));
    constexpr double most_turned = 1e9;  // what math::sincos takes
    if (!std::isfinite(grid.origin.x + grid.origin.y + grid.origin.z) ||
        !(std::abs(grid.yaw) <= most_turned))
        refuse("origin [m] must be finite and yaw [rad] from -1e9 to 1e9");
}

std::array<Vec3, 4> corners_of(const CellRectangle& r, const MapFrame& frame) {
    const double left = r.column0, bottom = r.row0, right = r.column1, top = r.row1;
    const double z = frame.floor();
    return {frame.to_world({left, bottom}, z), frame.to_world({right, bottom}, z),
            frame.to_world({right, top}, z), frame.to_world({left, top}, z)};
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

/// Scene::passable() for several storeys, checked part by part.
bool passable_by_storeys(const Scene& scene, Vec3 a, Vec3 b, Meters radius) {
    if (b.z < a.z) std::swap(a, b);
    const Storeys& storeys = scene.storeys();
    const std::size_t last = storeys.number_at(b.z);
    Vec3 from = a;
    for (std::size_t i = storeys.number_at(a.z); i <= last; ++i) {
        const Vec3 to = i == last ? b : a + ((storeys.top(i) - a.z) / (b.z - a.z)) * (b - a);
        if (!scene.storey(i).passable(from, to, radius)) return false;
        from = to;
    }
    return true;
}

}  // namespace

Scene::Scene() = default;
Scene::~Scene() = default;
Scene::Scene(const Scene&) = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(const Scene&) = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

Scene::Scene(OccupancyGrid grid, std::vector<Material> materials)
    : Scene(std::vector<OccupancyGrid>{std::move(grid)}, std::move(materials)) {}

Scene::Scene(std::vector<OccupancyGrid> maps, std::vector<Material> materials,
             std::vector<Material> ceilings)
    : materials_(std::move(materials)) {
    if (materials_.empty()) materials_.push_back({});
    for (const OccupancyGrid& map : maps) check(map, materials_.size());
    std::erase_if(maps, [](const OccupancyGrid& map) { return map.columns == 0; });
    std::map<double, std::vector<OccupancyGrid>> floors;
    for (OccupancyGrid& map : maps) floors[map.origin.z].push_back(std::move(map));
    std::vector<double> heights;
    for (const auto& [height, unused] : floors) heights.push_back(height);
    if (heights.empty()) heights.push_back(0);
    storeys_ = Storeys(std::move(heights), std::move(ceilings));
    if (floors.size() == 1) {
        build(std::move(floors.begin()->second), -endless, endless);
    } else {
        for (auto& [unused, here] : floors) add_storey(std::move(here));
    }
}

/// Adds a storey above the present ones.
void Scene::add_storey(std::vector<OccupancyGrid> maps) {
    const std::size_t number = plans_.size();
    const auto plan = std::make_shared<Scene>();
    plan->materials_ = materials_;
    plan->storeys_ = Storeys({storeys_.floor(number)}, {});
    plan->build(std::move(maps), storeys_.bottom(number), storeys_.top(number));
    if (number == 0) {
        grid_ = plan->grid_;
        frame_ = plan->frame_;
        obstacle_cells_ = plan->obstacle_cells_;
        faces_ = plan->faces_;
        lower_left_ = plan->lower_left_;
        upper_right_ = plan->upper_right_;
    }
    for (const WallLayer& layer : plan->layers_) {
        layers_.push_back(layer);
        layers_.back().storey = number;
    }
    plain_ = false;
    occupied_cells_ += plan->occupied_cells_;
    const Vec3 low = plan->lower_left_, high = plan->upper_right_;
    lower_left_ = {std::min(lower_left_.x, low.x), std::min(lower_left_.y, low.y), 0};
    upper_right_ = {std::max(upper_right_.x, high.x), std::max(upper_right_.y, high.y), 0};
    plans_.push_back(plan);
}

/// Builds a scene of one storey.
/// @param maps  maps on one floor, at least one
void Scene::build(std::vector<OccupancyGrid> maps, double bottom, double top) {
    std::vector<WallsOfMap> walls;
    for (std::size_t i = 0; i < maps.size(); ++i) {
        const std::size_t before = layers_.size();
        add_map(maps[i], bottom, top);
        for (std::size_t k = before; k < layers_.size(); ++k) {
            const WallLayer& layer = layers_[k];
            walls.push_back({layer.frame, layer.walls, layer.material, layer.top, i});
        }
    }
    faces_ = std::make_shared<const Faces>(std::move(walls));
    for (WallLayer& layer : layers_) layer.faces = faces_;
    grid_ = maps.size() == 1 ? std::move(maps.front()) : planning_grid(maps);
    frame_ = MapFrame(grid_);
    obstacle_cells_ = solid_rectangles(grid_, Solid::obstacles);
    plain_ = std::all_of(layers_.begin(), layers_.end(), [&](const WallLayer& layer) {
        return materials_[layer.material].follows_model() && layer.is_endless();
    });
}

void Scene::add_map(const OccupancyGrid& grid, double bottom, double top) {
    const MapFrame frame(grid);
    const auto index = [&](const std::vector<CellRectangle>& rectangles) {
        return std::make_shared<const WallIndex>(grid.columns, grid.rows, rectangles);
    };
    const auto used = materials_of(grid);
    const std::size_t before = layers_.size();
    for (const std::uint8_t material : used) {
        const auto walls = solid_rectangles(grid, WallsOf{material});
        layers_.push_back(
            {.frame = frame,
             .rectangles = walls,
             .walls = index(walls),
             .material = material,
             .bottom = bottom,
             .top = std::min(grid.origin.z + materials_[material].height.value, top)});
    }
    std::vector<std::shared_ptr<const WallIndex>> walls;
    for (std::size_t i = before; i < layers_.size(); ++i) walls.push_back(layers_[i].walls);
    const auto hollows = std::make_shared<const HollowWalls>(frame, std::move(walls));
    for (std::size_t i = before; i < layers_.size(); ++i) {
        WallLayer& layer = layers_[i];
        layer.hollows = hollows;
        layer.thickness = std::make_shared<const WallThickness>(frame, layer.walls, hollows);
    }
    const bool walls_are_all = used.size() == 1 && !has_unknown(grid);
    obstacles_.emplace_back(frame, walls_are_all ? layers_.back().walls
                                                 : index(solid_rectangles(grid, Solid::obstacles)));
    occupied_cells_ +=
        static_cast<std::size_t>(std::count(grid.cells.begin(), grid.cells.end(), Cell::occupied));
    bound(grid, frame);
}

/// Extends the bounding box of the maps by one map.
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

bool Scene::occupied(Vec3 p) const {
    if (!plans_.empty()) return storey_at(p.z).occupied(p);
    return std::any_of(layers_.begin(), layers_.end(), [&](const WallLayer& layer) {
        return layer.walls->holds(layer.frame.to_cells(p));
    });
}

bool Scene::inside_map(Vec3 p) const {
    if (!has_border()) return true;
    if (!plans_.empty()) return storey_at(p.z).inside_map(p);
    const CellPoint c = frame_.to_cells(p);
    return c.u >= 0 && c.u <= grid_.columns && c.v >= 0 && c.v <= grid_.rows;
}

double Scene::clearance(Vec3 p) const {
    if (!plans_.empty()) return storey_at(p.z).clearance(p);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Obstacles& map : obstacles_) nearest = std::min(nearest, map.clearance(p));
    return nearest;
}

bool Scene::passable(Vec3 a, Vec3 b, Meters radius) const {
    if (!plans_.empty()) return passable_by_storeys(*this, a, b, radius);
    return std::all_of(obstacles_.begin(), obstacles_.end(),
                       [&](const Obstacles& map) { return map.passable(a, b, radius); });
}

std::vector<Contact> Scene::contacts(Vec3 p, Meters radius) const {
    if (!plans_.empty()) return storey_at(p.z).contacts(p, radius);
    std::vector<Contact> all;
    for (const Obstacles& map : obstacles_) map.add_contacts(p, radius, all);
    if (!has_border()) return all;
    const CellPoint c = frame_.to_cells(p);
    const double gap_u = contact_gap / frame_.cell_width();
    const double gap_v = contact_gap / frame_.cell_height();
    constexpr double quarter = std::numbers::pi / 2;
    const std::array<bool, 4> borders{c.u >= grid_.columns - gap_u, c.v >= grid_.rows - gap_v,
                                      c.u <= gap_u, c.v <= gap_v};
    for (std::size_t side = 0; side < borders.size(); ++side) {
        const double towards = frame_.yaw() + quarter * static_cast<double>(side);
        if (borders[side]) all.push_back({towards, quarter});
    }
    return all;
}

std::vector<WallRectangle> Scene::wall_rectangles() const {
    std::vector<WallRectangle> all;
    for (const WallLayer& layer : layers_)
        for (const CellRectangle& r : layer.rectangles)
            all.push_back({corners_of(r, layer.frame), layer.material, layer.bottom, layer.top});
    return all;
}

std::vector<OccupancyGrid> Scene::maps() const {
    std::vector<OccupancyGrid> all;
    for (const auto& plan : plans_) {
        const auto here = plan->maps();
        all.insert(all.end(), here.begin(), here.end());
    }
    if (!plans_.empty()) return all;
    if (obstacles_.size() == 1) return {grid_};
    for (const WallLayer& layer : layers_) {
        OccupancyGrid map = layer.frame.map(layer.walls->columns(), layer.walls->rows());
        map.material = static_cast<std::uint8_t>(layer.material);
        map.open_ground = grid_.open_ground;
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
    out.faces_ = other.faces_;
    out.plain_ = other.plain_ && plans_.empty();
    out.occupied_cells_ = other.occupied_cells_;
    return out;
}

}  // namespace rovernet
