// SPDX-License-Identifier: MIT
#include "scene/stage/stage_walls.hpp"

#include "scene/images/image.hpp"
#include "scene/rectangles.hpp"
#include "scene/stage/wall_polygon.hpp"
#include "scene/stage/world_model.hpp"
#include "scene/stage/world_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

namespace rovernet {
namespace {

constexpr double radians = 3.14159265358979323846 / 180;  // per degree
constexpr double most_work = 256e6;                       // pixels, cells and edges of cells
constexpr double smallest_wall = 1e-6;                    // [m] thinner ones are none
constexpr double boundary_thickness = 0.01;               // [m]
constexpr double outline_cell = 0.02;                     // [m] Stage's usual resolution

bool is_wall(const Image& image, int column, int row) {
    const auto pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                       static_cast<std::size_t>(column);
    return image.samples[pixel * static_cast<std::size_t>(image.channels)] <= 127;
}

/// Part of an image that contains its walls; half open, row 0 on top.
CellRectangle walls_of(const Image& image) {
    CellRectangle box{image.width, image.height, 0, 0};
    for (int row = 0; row < image.height; ++row) {
        for (int column = 0; column < image.width; ++column) {
            if (!is_wall(image, column, row)) continue;
            box = {std::min(box.column0, column), std::min(box.row0, row),
                   std::max(box.column1, column + 1), std::max(box.row1, row + 1)};
        }
    }
    return box;
}

OccupancyGrid one_cell(double width, double height) {
    OccupancyGrid grid;
    grid.columns = grid.rows = 1;
    grid.cell_width = width;
    grid.cell_height = height;
    grid.cells = {Cell::occupied};
    return grid;
}

/// Whether a laser is stopped, the default of Stage. In Stage 2 and 3 it passes at 0, in Stage 4
/// only below 0.
bool seen(const WorldEntity& entity) {
    const WorldProperty* of_laser = entity.find("laser_return");
    const WorldProperty* of_ranger = entity.find("ranger_return");
    return !(of_laser && of_laser->number() <= 0) && !(of_ranger && of_ranger->number() < 0);
}

bool is_on(const WorldEntity& entity, std::string_view key) {
    const WorldProperty* given = entity.find(key);
    return given && given->number() != 0;
}

std::string color_of(const WorldEntity& entity) {
    if (const WorldProperty* color = entity.find("color")) return color->text();
    const WorldProperty* color = entity.find("color_rgba");
    if (!color) return "red";
    std::string name = "rgba";
    for (const auto& value : color->values) {
        const double* number = std::get_if<double>(&value);
        if (!number) {
            throw InputError(color->where,
                             "color_rgba: found a text; expected four numbers; write "
                             "color_rgba [1 0 0 1]");
        }
        name += fmt::format(" {}", *number);
    }
    return name;
}

/// Adds the names of all bitmaps of an entity: as written, and without their folders.
void add_bitmap_names(const WorldEntity& entity, std::vector<std::string>& names) {
    const WorldProperty* bitmap = entity.find("bitmap");
    if (bitmap && !bitmap->text().empty()) {
        const std::filesystem::path written(bitmap->text());
        names.push_back(written.filename().string());
        if (written.has_parent_path()) names.push_back(written.string());
    }
    for (const WorldEntity& child : entity.children) add_bitmap_names(child, names);
}

/// Notices about replacements OLD=NEW whose OLD is no bitmap of the world.
void note_unused(const WorldFile& world, const WorldOptions& options,
                 std::vector<std::string>& notices) {
    if (options.bitmaps.empty()) return;
    std::vector<std::string> names;
    add_bitmap_names(world.root, names);
    for (const auto& [old_name, new_name] : options.bitmaps) {
        if (std::ranges::find(names, old_name) != names.end()) continue;
        const std::string near = did_you_mean(old_name, names);
        notices.push_back(fmt::format(
            "{}: the world names no bitmap \"{}\", so the replacement {}={} has no effect{}{}",
            world.path, old_name, old_name, new_name, near.empty() ? "" : "; ", near));
    }
}

class Builder {
  public:
    Builder(const WorldFile& world, const WorldOptions& options)
        : options_(options), units_(world_units(world)), search_(world.path, options) {}

    StageWalls build(const WorldEntity& root) {
        add_children(root, {});
        return std::move(out_);
    }

  private:
    /// Position and size of a model's body.
    struct Body {
        WorldPose middle;
        WorldSize size;
        std::uint8_t material;
    };

    void add_children(const WorldEntity& parent, const WorldPose& pose);
    void add_model(const WorldEntity& model, const WorldPose& pose);
    void add_bitmap(const WorldProperty& bitmap, const Body& body);
    void add_outlines(std::vector<WallPolygon> outlines, const Body& body);
    void add_boundary(const Body& body);
    void place(OccupancyGrid grid, const Body& body);
    std::optional<std::string> picture(const WorldProperty& bitmap);
    const OccupancyGrid& drawing(const std::string& path, const Location& where);
    std::uint8_t material(const WorldEntity& model);
    void note(const Location& where, const std::string& text) {
        out_.notices.push_back(world_notice(where, text));
    }
    void spend(double work, const Location& where);

    const WorldOptions& options_;
    WorldUnits units_;
    WorldSearch search_;
    std::map<std::string, OccupancyGrid> drawings_;  // by path; only cells, columns and rows
    StageWalls out_;
    double work_ = 0;
    bool cells_noted_ = false;
};

void Builder::add_children(const WorldEntity& parent, const WorldPose& pose) {
    for (const auto& child : parent.children) {
        if (world_role(child) != WorldRole::wall) continue;
        const WorldPose own = pose * world_pose(child, "pose", units_);
        if (seen(child)) add_model(child, own);
        add_children(child, own);
    }
}

void Builder::add_model(const WorldEntity& model, const WorldPose& pose) {
    const WorldSize size = world_size(model, units_);
    if (size.x < smallest_wall || size.y < smallest_wall) return;
    auto outlines = wall_polygons(model);
    const WorldProperty* bitmap = model.find("bitmap");
    if (bitmap && bitmap->text().empty()) bitmap = nullptr;  // as in Stage: none
    const bool is_box = !bitmap && outlines.empty() && !is_on(model, "noblocks");
    const bool boundary = is_on(model, "boundary");
    if (!bitmap && !is_box && outlines.empty() && !boundary) return;
    const Body body{pose * world_pose(model, "origin", units_), size, material(model)};
    if (bitmap) add_bitmap(*bitmap, body);
    if (!outlines.empty()) add_outlines(std::move(outlines), body);
    if (is_box) {
        OccupancyGrid box = one_cell(size.x, size.y);
        box.origin = {-size.x / 2, -size.y / 2, 0};
        place(std::move(box), body);
    }
    if (boundary && !is_box) add_boundary(body);
    if (boundary && is_box) {
        note(model.where,
             "a model with a boundary and without a bitmap is a solid box, as in Stage; for only "
             "the boundary, write noblocks 1");
    }
}

void Builder::add_bitmap(const WorldProperty& bitmap, const Body& body) {
    const auto path = picture(bitmap);
    if (!path) return;
    OccupancyGrid grid = drawing(*path, bitmap.where);
    if (grid.cells.empty()) {
        return note(
            bitmap.where,
            fmt::format(
                "bitmap \"{}\" has no pixel with a grey level of at most 127, so it has no walls",
                *path));
    }
    grid.cell_width = body.size.x / grid.columns;
    grid.cell_height = body.size.y / grid.rows;
    grid.origin = {-body.size.x / 2, -body.size.y / 2, 0};
    place(std::move(grid), body);
}

/// Part of an image that contains its walls; each image is read only once.
const OccupancyGrid& Builder::drawing(const std::string& path, const Location& where) {
    const auto [entry, is_new] = drawings_.try_emplace(path);
    OccupancyGrid& grid = entry->second;
    spend(static_cast<double>(grid.cells.size()), where);
    if (!is_new) return grid;
    const Image image = read_image(path);
    spend(static_cast<double>(image.width) * image.height, where);
    const CellRectangle box = walls_of(image);
    if (box.column1 == 0) return grid;
    grid.columns = box.column1 - box.column0;
    grid.rows = box.row1 - box.row0;
    for (int row = box.row1 - 1; row >= box.row0; --row) {
        for (int column = box.column0; column < box.column1; ++column) {
            grid.cells.push_back(is_wall(image, column, row) ? Cell::occupied : Cell::free);
        }
    }
    return grid;
}

/// Path of the image, or empty if it is missing and that is allowed.
std::optional<std::string> Builder::picture(const WorldProperty& bitmap) {
    const std::filesystem::path written(bitmap.text());
    std::string name = written.string();
    const std::string last = written.filename().string();
    for (const auto& [old_name, new_name] : options_.bitmaps) {
        if (old_name == written || old_name == last) name = new_name;
    }
    WorldSearch::Result found = search_.find(name);
    if (found.path) return found.path;
    if (name != written) {  // beside the one that it stands for
        const auto beside = search_.find((written.parent_path() / name).string());
        if (beside.path) return beside.path;
        for (const auto& place : beside.tried) {
            const bool known = std::count(found.tried.begin(), found.tried.end(), place) > 0;
            if (!known) found.tried.push_back(place);
        }
    }
    if (options_.lenient) {
        note(bitmap.where,
             fmt::format("bitmap \"{}\" is missing, so its walls are left out; tried the paths {}",
                         name, found.places()));
        return std::nullopt;
    }
    throw InputError(bitmap.where,
                     fmt::format("bitmap: no file \"{}\"; tried the paths {}; give the file's "
                                 "folder with --world-path, or another file with --bitmap {}=NEW",
                                 name, found.places(), last));
}

void Builder::add_outlines(std::vector<WallPolygon> outlines, const Body& body) {
    const Location where = outlines.front().where;
    if (!fit(outlines, body.size)) {
        return note(where, "the outlines of a model have no area, so the model has no walls");
    }
    for (const auto& outline : outlines) {
        const Extent extent = extent_of(outline.points);
        if (extent.x1 - extent.x0 < smallest_wall || extent.y1 - extent.y0 < smallest_wall)
            continue;
        spend(filling_work(outline, outline_cell), outline.where);
        if (!outline.is_box() && !std::exchange(cells_noted_, true)) {
            note(outline.where,
                 fmt::format("each wall whose outline is not a box along the axes of its model is "
                             "approximated by cells of at most {} m",
                             outline_cell));
        }
        place(filled(outline, outline_cell), body);
    }
}

/// Adds boundary walls: left and right walls over the whole height, the others between them.
void Builder::add_boundary(const Body& body) {
    const double w = body.size.x, h = body.size.y;
    const double across = std::min(boundary_thickness, w / 2);
    const double up = std::min(boundary_thickness, h / 2);
    const auto add = [&](double x, double y, double width, double height) {
        if (width < smallest_wall || height < smallest_wall) return;
        OccupancyGrid wall = one_cell(width, height);
        wall.origin = {x, y, 0};
        place(std::move(wall), body);
    };
    add(-w / 2, -h / 2, across, h);
    add(w / 2 - across, -h / 2, across, h);
    add(-w / 2 + across, -h / 2, w - 2 * across, up);
    add(-w / 2 + across, h / 2 - up, w - 2 * across, up);
}

/// Transforms a grid from its place on the body to its place in the world.
void Builder::place(OccupancyGrid grid, const Body& body) {
    if (std::find(grid.cells.begin(), grid.cells.end(), Cell::occupied) == grid.cells.end()) return;
    const WorldPose corner = body.middle * WorldPose{grid.origin, 0};
    grid.origin = {corner.at.x, corner.at.y, 0};
    grid.yaw = corner.degrees * radians;
    grid.material = body.material;
    grid.open_ground = true;
    out_.grids.push_back(std::move(grid));
}

std::uint8_t Builder::material(const WorldEntity& model) {
    constexpr std::size_t most = 256;
    const std::string color = color_of(model);
    auto& materials = out_.materials;
    const auto found = std::find_if(materials.begin(), materials.end(),
                                    [&](const Material& m) { return m.name == color; });
    const auto index = static_cast<std::size_t>(found - materials.begin());
    if (index == most) {
        throw InputError(model.where,
                         fmt::format("color \"{}\" is one colour too many; expected at most {} "
                                     "colours of walls; use a colour that other walls have",
                                     color, most));
    }
    if (found == materials.end()) materials.push_back({.name = color});
    return static_cast<std::uint8_t>(index);
}

void Builder::spend(double work, const Location& where) {
    work_ += work;
    if (work_ <= most_work) return;
    throw InputError(where, fmt::format("the walls have more than {} million pixels and cells; "
                                        "expected fewer; scale the bitmap down",
                                        most_work / 1e6));
}

}  // namespace

StageWalls stage_walls(const WorldFile& world, const WorldOptions& options) {
    StageWalls walls = Builder(world, options).build(world.root);
    note_unused(world, options, walls.notices);
    return walls;
}

}  // namespace rovernet
