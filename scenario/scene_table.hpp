// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/door_table.hpp"
#include "scenario/floor_table.hpp"
#include "scenario/document/value.hpp"
#include "scene/doors.hpp"
#include "scene/materials/material.hpp"
#include "scene/scene.hpp"
#include "scene/stage/worldfile.hpp"
#include "sim/error.hpp"
#include "sim/fields.hpp"
#include "sim/units.hpp"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Maps, worlds and their materials as a scenario file gives them, and the scenes that they make:
//
//     [scene]
//     map = "office.png"
//     size = ["40 m", "20 m"]
//
//     [scene.materials]
//     brick = { grey = 100, itu = "brick", thickness = "0.2 m" }

namespace rovernet {

/// [scene.materials] NAME = { ... }: what walls of a grey level or a colour are made of. Its loss
/// is given by `per_crossing` and `per_metre`, which add up, or by `itu` and `thickness`.
struct MaterialTable {
    /// Grey level of its walls in a map: mean of red, green and blue, 0 ... 255; or `greys`.
    std::optional<int> grey;
    /// Grey levels of its walls in a map, first and last.
    std::optional<std::vector<int>> greys;
    /// Colour of its walls in a Stage world.
    std::optional<std::string> color;
    /// Loss of a wall [dB], however thick.
    std::optional<Db> per_crossing;
    /// Loss per length inside [dB/m].
    std::optional<DbPerMeter> per_metre;
    /// Material of ITU-R P.2040 of which each wall is a slab, of `thickness` [m].
    std::optional<ItuMaterial> itu;
    std::optional<Meters> thickness;
    /// Height of its walls [m]; none: [scene] wall_height.
    std::optional<Meters> height;
    /// Name, the table's key, and its place.
    std::string name = {};
    Location where = {};

    static constexpr auto fields() {
        constexpr Range level{.low = 0, .high = 255, .text = "from 0 to 255"};
        return describe(
            field("grey", &MaterialTable::grey, level, "grey level of its walls in the map"),
            field("greys", &MaterialTable::greys, "first and last of several grey levels"),
            field("color", &MaterialTable::color, "of its walls in a Stage world"),
            field("per_crossing", &MaterialTable::per_crossing, non_negative, "loss of a wall"),
            field("per_metre", &MaterialTable::per_metre, non_negative, "loss per length inside"),
            field("itu", &MaterialTable::itu, "a slab of this material of ITU-R P.2040"),
            field("thickness", &MaterialTable::thickness, positive, "of the slab"),
            field("height", &MaterialTable::height, positive, "of its walls"));
    }
    /// Whether it says which walls are made of it; else it is for doors.
    bool has_walls() const { return grey || greys || color; }
    /// Whether walls of this grey level are made of it.
    bool has_grey(int level) const {
        return grey == level || (greys && (*greys)[0] <= level && level <= (*greys)[1]);
    }
};

/// [scene]: the map, the floors or the Stage world, and what their walls are made of. Without any
/// it is an open field.
struct SceneTable {
    /// ROS map.yaml, or a picture with a `size`; relative to the scenario file.
    std::optional<std::string> map;
    /// Width and height of a picture [m]: two lengths > 0.
    std::optional<std::vector<Meters>> size;
    /// Floors of a building of several storeys, from the lowest up; instead of a map.
    std::vector<FloorTable> floors = {};
    /// Stage world, instead of a map; its robots join those of the file.
    std::optional<std::string> world;
    /// Folders where includes and bitmaps of the world are looked for, too; bitmaps by other names,
    /// "OLD=NEW"; a missing one is a notice.
    std::optional<std::vector<std::string>> world_path;
    std::optional<std::vector<std::string>> bitmaps;
    bool lenient = false;
    /// Height of one storey [m], for losses by floor; none: there is one storey, or `floors`.
    std::optional<Meters> floor_height;
    /// Height [m] of walls whose material has none, above their floor; none: endless, or up to the
    /// ceiling.
    std::optional<Meters> wall_height;
    /// Materials in their order: the first that fits a wall counts.
    std::vector<MaterialTable> materials = {};
    /// Doors, in the order of the file.
    std::vector<DoorTable> doors = {};
    /// Place of the key `map` or `world`.
    Location map_where = {};

    /// Whether it has maps: one, or those of floors.
    bool has_maps() const { return map || !floors.empty(); }

    static constexpr auto fields() {
        return describe(
            field("map", &SceneTable::map,
                  "ROS map.yaml, or a PNG or PGM with a size; relative to the scenario file"),
            field("size", &SceneTable::size, "width and height of a picture used as a map"),
            field("world", &SceneTable::world, "Stage world file, instead of a map"),
            field("world_path", &SceneTable::world_path,
                  "folders where includes and bitmaps of the world are looked for, too"),
            field("bitmaps", &SceneTable::bitmaps,
                  "\"OLD=NEW\": bitmaps of the world by other names"),
            field("lenient", &SceneTable::lenient,
                  "a missing include or bitmap of the world is a notice, not an error"),
            field("floor_height", &SceneTable::floor_height, positive,
                  "of one storey; storeys are not counted if not given"),
            field("wall_height", &SceneTable::wall_height, positive,
                  "of walls whose material has none of its own; endless if not given"));
    }
};

/// Reads [scene]; the map itself is not looked at.
/// @throws InputError at the first mistake
SceneTable read_scene(const Value& value);
/// Table that reads back as the same scene, with every default but `lenient`.
Table scene_document(const SceneTable& scene);

/// Options with which the scene's world is to be read.
/// @param file  scenario file, whose folder theirs are relative to
WorldOptions world_options(const SceneTable& scene, const std::string& file);

/// Scene of the map or of the floors; null for an open field. A file NAME.materials.toml beside a
/// map has materials of that map, too, which come after those of the scenario.
/// @param file     scenario file, whose folder the maps are relative to
/// @param notices  appended: materials that make no wall, though a map has their grey
/// @throws InputError naming the scenario's line, then the map's own error
std::shared_ptr<const Scene> load_map(const SceneTable& scene, const std::string& file,
                                      std::vector<std::string>& notices);

/// Scene of the walls of the scene's world; null if it has none.
/// @param world    the world, which is read already
/// @param notices  appended
/// @throws InputError with its place in the world
std::shared_ptr<const Scene> load_walls(const SceneTable& scene, const std::string& file,
                                        const WorldFile& world, std::vector<std::string>& notices);

/// Doors of a scene, with what they are made of.
std::vector<Door> doors_of(const SceneTable& scene);
/// Changes of a scene by its doors; none if it has none.
/// @param open  what load_map() or load_walls() gave
/// @throws InputError for a door that lies off the map, or on two storeys
std::vector<SceneChange> load_doors(const SceneTable& scene,
                                    const std::shared_ptr<const Scene>& open);

/// Refuses doors where links are looked at in one scene.
/// @param who  command or method that does, for the message
/// @throws InputError at the first door, if there is one
void refuse_doors(const SceneTable& scene, std::string_view who);

}  // namespace rovernet
