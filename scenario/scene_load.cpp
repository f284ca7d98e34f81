// SPDX-License-Identifier: MIT
#include "scenario/scene_table.hpp"
#include "scenario/toml.hpp"
#include "scene/occupancy.hpp"
#include "scene/stage/stage_walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace rovernet {
namespace {

namespace fs = std::filesystem;

Material made_of(const MaterialTable& table, std::optional<Meters> usual_height) {
    Material material{.name = table.name,
                      .per_crossing = table.per_crossing,
                      .per_metre = table.per_metre,
                      .slab = table.itu};
    if (table.thickness) material.thickness = *table.thickness;
    if (const auto height = table.height ? table.height : usual_height) material.height = *height;
    return material;
}

/// The materials file beside a map: NAME.materials.toml for NAME.png or NAME.yaml.
std::vector<MaterialTable> sidecar(const fs::path& map) {
    const fs::path path = fs::path(map).replace_extension(".materials.toml");
    if (!fs::is_regular_file(path)) return {};
    Table scene;
    scene.set("materials", read_toml(path.string()));
    return read_scene(Value(std::move(scene))).materials;
}

OccupancyGrid load_grid(const SceneTable& scene, const fs::path& path) {
    const auto extension = path.extension();
    const bool yaml = extension == ".yaml" || extension == ".yml";
    if (yaml && scene.size) {
        throw InputError(scene.map_where,
                         "map: a map.yaml has its own size; leave out the key size");
    }
    if (!yaml && fs::is_regular_file(path) && !scene.size) {
        throw InputError(scene.map_where,
                         fmt::format("map: \"{}\" is a picture without a scale; expected a ROS "
                                     "map.yaml, or also size = [\"40 m\", \"20 m\"]",
                                     *scene.map));
    }
    if (yaml) return read_ros_map(path.string());
    const auto size = scene.size.value_or(std::vector<Meters>{{1}, {1}});
    return image_map(path.string(), size[0], size[1]);
}

/// The materials' pixels of a map: how many, and how many of them are walls.
struct Pixels {
    std::size_t all = 0, walls = 0;
};

/// Notices a material that no wall is made of, or not all of its pixels: it was meant otherwise.
void note_pixels(const MaterialTable& material, Pixels pixels, std::string_view map,
                 std::vector<std::string>& notices) {
    if (pixels.walls == pixels.all && pixels.all > 0) return;
    const bool has_grey = material.grey || material.greys;
    if (!has_grey) {
        return notices.push_back(
            fmt::format("{}: material \"{}\" has no grey, and a map has no colours: it is not used",
                        material.where.text(), material.name));
    }
    if (pixels.all == 0) {
        return notices.push_back(
            fmt::format("{}: material \"{}\" fits no pixel of {}; the first material "
                        "that fits counts",
                        material.where.text(), material.name, map));
    }
    notices.push_back(fmt::format(
        "{}: material \"{}\": {} of its {} pixels in {} are no walls, and let the radio pass; "
        "their grey is too light: darken it, or lower the map's occupied_thresh",
        material.where.text(), material.name, pixels.all - pixels.walls, pixels.all, map));
}

/// Gives each wall the first material that has its grey level; 0 is the usual one.
void assign_materials(OccupancyGrid& grid, const std::vector<MaterialTable>& tables,
                      std::string_view map, std::vector<std::string>& notices) {
    if (tables.empty()) return;
    std::vector<std::uint8_t> by_level(256, 0);
    for (int level = 0; level < 256; ++level) {
        const auto found = std::find_if(tables.begin(), tables.end(),
                                        [&](const auto& t) { return t.has_grey(level); });
        if (found != tables.end()) {
            by_level[static_cast<std::size_t>(level)] =
                static_cast<std::uint8_t>(found - tables.begin() + 1);
        }
    }
    grid.cell_materials.resize(grid.cells.size());
    std::vector<Pixels> pixels(tables.size() + 1);
    for (std::size_t i = 0; i < grid.cells.size(); ++i) {
        const std::uint8_t material = by_level[grid.greys[i]];
        grid.cell_materials[i] = material;
        ++pixels[material].all;
        pixels[material].walls += grid.cells[i] == Cell::occupied;
    }
    for (std::size_t i = 0; i < tables.size(); ++i) {
        note_pixels(tables[i], pixels[i + 1], map, notices);
    }
}

std::shared_ptr<const Scene> map_scene(const SceneTable& scene, const std::string& file,
                                       std::vector<std::string>& notices) {
    const fs::path path = fs::path(file).parent_path() / *scene.map;
    std::vector<MaterialTable> tables = scene.materials;
    for (const MaterialTable& more : sidecar(path)) tables.push_back(more);
    constexpr std::size_t most = 254;
    if (tables.size() > most) {
        throw InputError(tables[most].where, "materials: expected at most 254 of them");
    }
    OccupancyGrid grid = load_grid(scene, path);
    assign_materials(grid, tables, *scene.map, notices);
    std::vector<Material> materials{made_of({}, scene.wall_height)};
    materials.front().name = "wall";
    for (const MaterialTable& table : tables) {
        materials.push_back(made_of(table, scene.wall_height));
    }
    return std::make_shared<const Scene>(std::move(grid), std::move(materials));
}

}  // namespace

WorldOptions world_options(const SceneTable& scene, const std::string& file) {
    const fs::path folder = fs::path(file).parent_path();
    WorldOptions options{.lenient = scene.lenient};
    for (const std::string& path : scene.world_path.value_or(std::vector<std::string>{})) {
        options.search_path.push_back((folder / path).string());
    }
    for (const std::string& pair : scene.bitmaps.value_or(std::vector<std::string>{})) {
        const auto equals = pair.find('=');
        options.bitmaps.emplace_back(pair.substr(0, equals), pair.substr(equals + 1));
    }
    return options;
}

std::shared_ptr<const Scene> load_map(const SceneTable& scene, const std::string& file,
                                      std::vector<std::string>& notices) {
    if (!scene.map) return nullptr;
    try {
        return map_scene(scene, file, notices);
    } catch (const InputError& error) {
        if (error.where().source == scene.map_where.source) throw;
        throw InputError(scene.map_where, std::string("map: ") + error.what());
    } catch (const std::invalid_argument& error) {
        throw InputError(scene.map_where, error.what());
    }
}

std::shared_ptr<const Scene> load_walls(const SceneTable& scene, const std::string& file,
                                        const WorldFile& world, std::vector<std::string>& notices) {
    StageWalls walls = stage_walls(world, world_options(scene, file));
    notices.insert(notices.end(), walls.notices.begin(), walls.notices.end());
    for (Material& material : walls.materials) {
        const auto found =
            std::find_if(scene.materials.begin(), scene.materials.end(),
                         [&](const MaterialTable& t) { return t.color == material.name; });
        material = found == scene.materials.end() ? Material{.name = material.name}
                                                  : made_of(*found, std::nullopt);
        if (scene.wall_height && found == scene.materials.end())
            material.height = *scene.wall_height;
    }
    for (const MaterialTable& table : scene.materials) {
        const bool used = std::any_of(walls.materials.begin(), walls.materials.end(),
                                      [&](const Material& m) { return table.color == m.name; });
        if (used) continue;
        notices.push_back(fmt::format("{}: material \"{}\": no wall of the world has its colour",
                                      table.where.text(), table.name));
    }
    if (walls.grids.empty()) return nullptr;
    return std::make_shared<const Scene>(std::move(walls.grids), std::move(walls.materials));
}

}  // namespace rovernet
