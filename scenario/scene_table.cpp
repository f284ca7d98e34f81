// SPDX-License-Identifier: MIT
#include "scenario/scene_table.hpp"

#include "scenario/tables/reader.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rovernet {
namespace {

void check_greys(const MaterialTable& material, TableReader& table) {
    if (!material.greys) return;
    const auto& levels = *material.greys;
    if (levels.size() == 2 && levels[0] >= 0 && levels[0] <= levels[1] && levels[1] <= 255) return;
    throw InputError(
        table.take("greys")->where,
        "greys: expected two grey levels from 0 to 255, the lower level first, such as [90, 110]");
}

MaterialTable read_material(const Entry& entry) {
    TableReader table(entry.value, fmt::format("material \"{}\"", entry.key));
    table.expect<MaterialTable>();
    MaterialTable material;
    table.read_fields(material);
    material.name = entry.key;
    material.where = entry.key_where;
    Value name{entry.key};
    name.where = entry.key_where;
    check_printable(name, "material", entry.key);
    check_greys(material, table);
    if (material.grey && material.greys) table.only_one_of("grey", "greys");
    if (material.itu && !material.thickness) table.missing("thickness", "thickness = \"0.1 m\"");
    if (material.thickness && !material.itu) table.missing("itu", "itu = \"brick\"");
    if (material.itu && material.per_crossing) table.only_one_of("itu", "per_crossing");
    if (material.itu && material.per_metre) table.only_one_of("itu", "per_metre");
    return material;
}

/// Checks that each material has walls, or doors.
void check_uses(const SceneTable& scene, const Value& materials) {
    for (const MaterialTable& material : scene.materials) {
        const bool has_doors =
            std::any_of(scene.doors.begin(), scene.doors.end(),
                        [&](const DoorTable& door) { return door.material == material.name; });
        if (material.has_walls() || has_doors) continue;
        TableReader table(*materials.table()->find(material.name),
                          fmt::format("material \"{}\"", material.name));
        MaterialTable known;
        table.read_fields(known);
        table.missing("grey",
                      "grey = 100, greys = [90, 110], color = \"red\", or a door of this material");
    }
}

/// Checks that the materials of doors are there.
void check_doors(const SceneTable& scene) {
    for (const DoorTable& door : scene.doors) {
        if (!door.material) continue;
        std::vector<std::string> names;
        for (const MaterialTable& material : scene.materials) names.push_back(material.name);
        if (std::find(names.begin(), names.end(), *door.material) != names.end()) continue;
        const std::string near = did_you_mean(*door.material, names);
        throw InputError(
            door.material_where,
            fmt::format(
                "material: found \"{}\"; expected the name of a material in [scene.materials]{}",
                *door.material, near.empty() ? "" : "; " + near));
    }
}

void check_size(const SceneTable& scene, TableReader& table) {
    if (!scene.size) return;
    const Location& where = table.take("size")->where;
    if (!scene.map) {
        throw InputError(
            where,
            "size: found a size without a map; expected also a map, such as map = \"office.png\"");
    }
    check_map_size(*scene.size, where);
}

/// Checks that no other key of [scene] contradicts the floors.
void check_floors(const SceneTable& scene, TableReader& table) {
    if (scene.floors.empty()) return;
    for (const char* key : {"map", "size", "world", "floor_height"}) {
        if (table.table().find(key)) table.only_one_of("floor", key);
    }
}

void check_world(const SceneTable& scene, TableReader& table) {
    if (scene.map && scene.world) table.only_one_of("map", "world");
    for (const char* key : {"world_path", "bitmaps", "lenient"}) {
        if (table.table().find(key) && !scene.world) {
            table.missing(
                "world",
                fmt::format("world = \"robots.world\"; the key \"{}\" needs the key \"world\"",
                            key));
        }
    }
    for (const std::string& pair : scene.bitmaps.value_or(std::vector<std::string>{})) {
        const auto equals = pair.find('=');
        if (equals != 0 && equals != pair.npos && equals + 1 != pair.size()) continue;
        throw InputError(table.take("bitmaps")->where,
                         fmt::format("bitmaps: found \"{}\"; expected \"OLD=NEW\", such as "
                                     "\"cave_f.png=cave_filled.png\"",
                                     pair));
    }
}

}  // namespace

SceneTable read_scene(const Value& value) {
    TableReader table(value, "[scene]");
    table.expect<SceneTable>({"floor", "door", "materials"});
    SceneTable scene;
    table.read_fields(scene);
    if (const Value* floors = table.take("floor")) scene.floors = read_floors(*floors);
    if (const Value* doors = table.take("door")) scene.doors = read_doors(*doors);
    const Value* materials = table.take("materials");
    check_floors(scene, table);
    const Value* source = table.table().find(scene.world ? "world" : "map");
    scene.map_where = source ? source->where : value.where;
    check_size(scene, table);
    check_world(scene, table);
    if (materials) {
        for (const Entry& entry : TableReader(*materials, "[scene.materials]").table().entries) {
            scene.materials.push_back(read_material(entry));
        }
    }
    check_doors(scene);
    if (materials) check_uses(scene, *materials);
    return scene;
}

void refuse_doors(const SceneTable& scene, std::string_view who) {
    if (scene.doors.empty()) return;
    throw InputError(scene.doors.front().where,
                     fmt::format("door: {} needs a scene that does not change; expected a scenario "
                                 "without [[scene.door]]",
                                 who));
}

Table scene_document(const SceneTable& scene) {
    Table table;
    append_fields(table, scene);
    if (!scene.lenient) std::erase_if(table.entries, [](auto& e) { return e.key == "lenient"; });
    if (!scene.floors.empty()) table.set("floor", floors_document(scene.floors));
    if (!scene.doors.empty()) table.set("door", doors_document(scene.doors));
    Table materials;
    for (const MaterialTable& material : scene.materials) {
        Table each;
        append_fields(each, material);
        materials.set(material.name, std::move(each));
    }
    if (!materials.entries.empty()) table.set("materials", std::move(materials));
    return table;
}

}  // namespace rovernet
