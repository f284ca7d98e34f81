// SPDX-License-Identifier: MIT
#include "files/input_file.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scene_table.hpp"
#include "scene/doors.hpp"
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
    if (input_kind(path.string()) != InputKind::file) return {};
    Table scene;
    scene.set("materials", read_toml(path.string()));
    return read_scene(Value(std::move(scene))).materials;
}

OccupancyGrid load_grid(const FloorTable& floor, const fs::path& path,
                        std::vector<std::string>& notices) {
    const auto extension = path.extension();
    const bool yaml = extension == ".yaml" || extension == ".yml";
    if (yaml && floor.size) {
        throw InputError(
            floor.map_where,
            "map: a map.yaml contains the size of the map; leave out the key \"size\"");
    }
    if (!yaml && input_kind(path.string()) == InputKind::file && !floor.size) {
        throw InputError(
            floor.map_where,
            fmt::format("map: \"{}\" is a picture without a scale; expected a ROS "
                        "map.yaml, or this picture together with size = [\"40 m\", \"20 m\"]",
                        floor.map));
    }
    if (yaml) return read_ros_map(path.string(), notices);
    const auto size = floor.size.value_or(std::vector<Meters>{{1}, {1}});
    return image_map(path.string(), size[0], size[1]);
}

/// The materials' pixels of a map: how many, and how many of them are walls.
struct Pixels {
    std::size_t all = 0, walls = 0;
};

/// Adds a notice about a material without walls, or with pixels that are no wall: probably a
/// mistake.
void note_pixels(const MaterialTable& material, Pixels pixels, std::string_view map,
                 std::vector<std::string>& notices) {
    if (pixels.walls == pixels.all && pixels.all > 0) return;
    if (!material.has_walls()) return;  // it is for doors
    const bool has_grey = material.grey || material.greys;
    if (!has_grey) {
        return notices.push_back(
            fmt::format("{}: material \"{}\" is not used: in a map, only the key \"grey\" or "
                        "\"greys\" gives walls a material, and this material has neither key",
                        material.where.text(), material.name));
    }
    if (pixels.all == 0) {
        return notices.push_back(
            fmt::format("{}: material \"{}\" matches no pixel of {}; if several materials match a "
                        "pixel, the first of them counts",
                        material.where.text(), material.name, map));
    }
    notices.push_back(fmt::format(
        "{}: material \"{}\": {} of its {} pixels in {} are not walls and do not attenuate radio, "
        "because their grey is too light: darken these pixels, or lower the map's occupied_thresh",
        material.where.text(), material.name, pixels.all - pixels.walls, pixels.all, map));
}

/// Materials of all maps of a scene, and the pixels that they have: those of the scenario first,
/// then those of the file beside each map.
class Palette {
  public:
    explicit Palette(const std::vector<MaterialTable>& of_scenario) : shared_(of_scenario.size()) {
        append(of_scenario);
    }

    /// Gives each wall of a map the first material with its grey level; 0 is the default material.
    /// @param name  of the map, for notices
    void paint(OccupancyGrid& grid, const fs::path& map, const std::string& name);
    /// Materials by their numbers.
    std::vector<Material> materials(std::optional<Meters> usual_height) const;
    /// Notices materials that make no wall, or not of all of their pixels.
    /// @param shared_map  where those of the scenario were looked for
    void note(std::string_view shared_map, std::vector<std::string>& notices) const;

  private:
    void append(const std::vector<MaterialTable>& more);

    std::vector<MaterialTable> tables_;
    std::size_t shared_;
    std::vector<Pixels> pixels_ = {{}};   // by number
    std::vector<std::string> maps_ = {};  // of the materials that are not shared
};

void Palette::append(const std::vector<MaterialTable>& more) {
    tables_.insert(tables_.end(), more.begin(), more.end());
    pixels_.resize(tables_.size() + 1);
    constexpr std::size_t most = 254;
    if (tables_.size() <= most) return;
    throw InputError(
        tables_[most].where,
        fmt::format("materials: found {} materials; expected at most {}", tables_.size(), most));
}

void Palette::paint(OccupancyGrid& grid, const fs::path& map, const std::string& name) {
    const std::size_t own = tables_.size();
    append(sidecar(map));
    maps_.resize(tables_.size() - shared_, name);
    if (tables_.empty()) return;
    std::vector<std::uint8_t> by_level(256, 0);
    for (int level = 0; level < 256; ++level) {
        for (std::size_t i = 0; i < tables_.size(); ++i) {
            if ((i >= shared_ && i < own) || !tables_[i].has_grey(level)) continue;
            by_level[static_cast<std::size_t>(level)] = static_cast<std::uint8_t>(i + 1);
            break;
        }
    }
    grid.cell_materials.resize(grid.cells.size());
    for (std::size_t i = 0; i < grid.cells.size(); ++i) {
        const std::uint8_t material = by_level[grid.greys[i]];
        grid.cell_materials[i] = material;
        ++pixels_[material].all;
        pixels_[material].walls += grid.cells[i] == Cell::occupied;
    }
}

std::vector<Material> Palette::materials(std::optional<Meters> usual_height) const {
    std::vector<Material> all{made_of({}, usual_height)};
    all.front().name = "wall";
    for (const MaterialTable& table : tables_) all.push_back(made_of(table, usual_height));
    return all;
}

void Palette::note(std::string_view shared_map, std::vector<std::string>& notices) const {
    for (std::size_t i = 0; i < tables_.size(); ++i) {
        note_pixels(tables_[i], pixels_[i + 1],
                    i < shared_ ? shared_map : std::string_view(maps_[i - shared_]), notices);
    }
}

/// Runs load() for the map that a key of the scenario names.
auto located_map(const Location& where, auto&& load) {
    try {
        return load();
    } catch (const InputError& error) {
        if (error.where().source == where.source) throw;
        throw InputError(where, std::string("map: ") + error.what());
    } catch (const std::invalid_argument& error) {
        throw InputError(where, error.what());
    }
}

Material made_of(const CeilingTable& table) {
    Material ceiling{.name = "ceiling", .per_crossing = table.per_crossing, .slab = table.itu};
    if (table.thickness) ceiling.thickness = *table.thickness;
    return ceiling;
}

/// Checks that a door lies within the maps, on one storey.
void check_place(const Door& door, const DoorTable& table, const Scene& scene) {
    const std::string name = table.name ? fmt::format("door \"{}\"", *table.name) : "door";
    const Storeys& storeys = scene.storeys();
    if (storeys.number_at(door.from.z) != storeys.number_at(door.to.z)) {
        throw InputError(table.where, name +
                                          ": the two ends of the door are on different storeys; "
                                          "expected both ends on the same storey");
    }
    const Scene& storey = scene.storey_at(door.from.z);
    for (const Vec3 corner : door.corners()) {
        if (storey.inside_map(corner)) continue;
        const Vec3 low = storey.lower_left(), high = storey.upper_right();
        throw InputError(
            table.where,
            fmt::format("{}: the corner of the door at ({:.3f}, {:.3f}) m lies off the map; "
                        "expected a door between ({:.3f}, {:.3f}) and ({:.3f}, {:.3f})",
                        name, corner.x, corner.y, low.x, low.y, high.x, high.y));
    }
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
    if (!scene.has_maps()) return nullptr;
    std::vector<FloorTable> floors = scene.floors;
    if (scene.map) floors = {{.map = *scene.map, .size = scene.size, .map_where = scene.map_where}};
    Palette palette(scene.materials);
    std::vector<OccupancyGrid> maps;
    std::vector<Material> ceilings;
    for (const FloorTable& floor : floors) {
        const fs::path path = fs::path(file).parent_path() / floor.map;
        if (const auto beside = named_beside(fs::path(file).parent_path().string(), floor.map);
            !beside.empty())
            throw InputError(floor.map_where,
                             fmt::format("map: there is no file \"{}\", but there is \"{}\" in the "
                                         "same folder; write map = \"{}\"",
                                         floor.map, beside, beside));
        located_map(floor.map_where, [&] {
            maps.push_back(load_grid(floor, path, notices));
            maps.back().origin.z = floor.height.value;
            palette.paint(maps.back(), path, floor.map);
        });
        ceilings.push_back(made_of(floor.ceiling.value_or(CeilingTable{})));
    }
    ceilings.pop_back();
    palette.note(scene.map ? *scene.map : "the maps", notices);
    return located_map(floors.front().map_where, [&] {
        return std::make_shared<const Scene>(std::move(maps), palette.materials(scene.wall_height),
                                             std::move(ceilings));
    });
}

std::shared_ptr<const Scene> load_walls(const SceneTable& scene, const std::string& file,
                                        const WorldFile& world, std::vector<std::string>& notices) {
    StageWalls walls = stage_walls(world, world_options(scene, file));
    notices.insert(notices.end(), walls.notices.begin(), walls.notices.end());
    std::vector<std::string> colors;  // of the walls
    for (Material& material : walls.materials) {
        colors.push_back(material.name);
        const auto found =
            std::find_if(scene.materials.begin(), scene.materials.end(),
                         [&](const MaterialTable& t) { return t.color == material.name; });
        material = found == scene.materials.end() ? Material{.name = material.name}
                                                  : made_of(*found, std::nullopt);
        if (scene.wall_height && found == scene.materials.end())
            material.height = *scene.wall_height;
    }
    for (const MaterialTable& table : scene.materials) {
        if (!table.has_walls()) continue;
        const bool used = std::any_of(colors.begin(), colors.end(),
                                      [&](const auto& color) { return table.color == color; });
        if (used) continue;
        notices.push_back(fmt::format(
            "{}: material \"{}\": no wall of the Stage world has the colour of this material; its "
            "walls have the colours {}",
            table.where.text(), table.name, fmt::join(colors, ", ")));
    }
    if (walls.grids.empty()) return nullptr;
    return std::make_shared<const Scene>(std::move(walls.grids), std::move(walls.materials));
}

std::vector<Door> doors_of(const SceneTable& scene) {
    std::vector<Door> doors;
    for (const DoorTable& table : scene.doors) {
        const auto named =
            std::find_if(scene.materials.begin(), scene.materials.end(),
                         [&](const MaterialTable& m) { return m.name == table.material; });
        const bool usual = named == scene.materials.end();
        Material material = made_of(usual ? MaterialTable{} : *named, scene.wall_height);
        if (usual) material.name = "wall";
        doors.push_back({.from = table.from,
                         .to = table.to,
                         .thickness = table.thickness,
                         .material = std::move(material),
                         .closes = table.closes,
                         .opens = table.opens});
    }
    return doors;
}

std::vector<SceneChange> load_doors(const SceneTable& scene,
                                    const std::shared_ptr<const Scene>& open) {
    const std::vector<Door> doors = doors_of(scene);
    for (std::size_t i = 0; i < doors.size(); ++i) {
        if (!open) {
            throw InputError(scene.doors[i].where,
                             "door: found a door in a scene without walls (an open field); "
                             "expected also a map, floors or a world with walls");
        }
        check_place(doors[i], scene.doors[i], *open);
    }
    return scene_changes(open, doors);
}

}  // namespace rovernet
