// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "scenario/door_table.hpp"
#include "scenario/floor_table.hpp"
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

// Maps, Stage worlds and materials in a scenario file, and the scenes made of them:
//
//     [scene]
//     map = "office.png"
//     size = ["40 m", "20 m"]
//
//     [scene.materials]
//     brick = { grey = 100, itu = "brick", thickness = "0.2 m" }

namespace rovernet {

/// [scene.materials] NAME = { ... }: material of the walls that have a given grey level or colour.
/// The loss of a wall is the sum of `per_crossing` and of `per_metre` times the length inside, or
/// follows from `itu` and `thickness`.
struct MaterialTable {
    /// Grey level of walls of this material in a map: mean of red, green and blue, 0 ... 255; none:
    /// `greys` or `color` is given, or only doors have this material.
    std::optional<int> grey;
    /// First and last grey level of walls of this material in a map, both included, 0 ... 255.
    std::optional<std::vector<int>> greys;
    /// Colour of walls of this material in a Stage world.
    std::optional<std::string> color;
    /// Loss of a wall [dB], for any thickness.
    std::optional<Db> per_crossing;
    /// Loss per length of path inside a wall [dB/m].
    std::optional<DbPerMeter> per_metre;
    /// Material of ITU-R P.2040, and thickness [m]. Each wall has the loss of a slab of this
    /// material and thickness.
    std::optional<ItuMaterial> itu;
    std::optional<Meters> thickness;
    /// Height of walls of this material [m]; none: the key wall_height of [scene].
    std::optional<Meters> height;
    /// Name of the material (key of the table), and file position of the table.
    std::string name = {};
    Location where = {};

    static constexpr auto fields() {
        constexpr Range level{.low = 0, .high = 255, .text = "from 0 to 255"};
        return describe(field("grey", &MaterialTable::grey, level,
                              "grey level of the walls of this material in the map"),
                        field("greys", &MaterialTable::greys,
                              "instead of `grey`: first and last grey level of a range"),
                        field("color", &MaterialTable::color,
                              "colour of the walls of this material in a Stage world"),
                        field("per_crossing", &MaterialTable::per_crossing, non_negative,
                              "loss each time that a signal crosses a wall"),
                        field("per_metre", &MaterialTable::per_metre, non_negative,
                              "loss for each metre of the signal's path inside a wall"),
                        field("itu", &MaterialTable::itu,
                              "material of ITU-R P.2040; the loss of a wall is that of a flat slab "
                              "of this material; needs `thickness`"),
                        field("thickness", &MaterialTable::thickness, positive,
                              "thickness of the slab, for `itu`"),
                        field("height", &MaterialTable::height, positive,
                              "height of the walls of this material"));
    }
    /// Whether walls of the map or of the Stage world can have this material. A material without
    /// grey level and colour is for doors only.
    bool has_walls() const { return grey || greys || color; }
    /// Whether walls of the given grey level (0 ... 255) have this material.
    bool has_grey(int level) const {
        return grey == level || (greys && (*greys)[0] <= level && level <= (*greys)[1]);
    }
};

/// [scene]: the map, the floors or the Stage world, and the materials of walls. Without map, floors
/// and Stage world the scene is an open field.
struct SceneTable {
    /// Path of the map, relative to the scenario file: a ROS map.yaml, or a picture with a `size`.
    std::optional<std::string> map;
    /// Width and height of a map that is a picture [m]: two lengths > 0.
    std::optional<std::vector<Meters>> size;
    /// Floors of a building of several storeys, from the lowest up; instead of a map.
    std::vector<FloorTable> floors = {};
    /// Path of a Stage world file, given instead of a map. The robots of the world are added to the
    /// robots of the scenario file.
    std::optional<std::string> world;
    /// Options for reading the Stage world. `world_path`: further folders in which includes and
    /// bitmaps are searched. `bitmaps`: replacements of bitmaps, "OLD=NEW". `lenient`: whether a
    /// missing file is a notice instead of an error.
    std::optional<std::vector<std::string>> world_path;
    std::optional<std::vector<std::string>> bitmaps;
    bool lenient = false;
    /// Height of one storey [m], by which the floors between two antennas are counted. None: there
    /// is one storey, or `floors` gives the heights.
    std::optional<Meters> floor_height;
    /// Height above the floor [m] of walls whose material gives no height. None: walls reach up to
    /// the ceiling, or are infinitely high without a ceiling.
    std::optional<Meters> wall_height;
    /// Materials, in the order of the file. A wall has the first material with the wall's grey
    /// level or colour.
    std::vector<MaterialTable> materials = {};
    /// Doors, in the order of the file.
    std::vector<DoorTable> doors = {};
    /// File position of the key `map` or `world`, for error messages.
    Location map_where = {};

    /// Whether the scene has a map, or floors with maps.
    bool has_maps() const { return map || !floors.empty(); }

    static constexpr auto fields() {
        return describe(
            field("map", &SceneTable::map,
                  "map: a map.yaml of ROS, or a picture (then `size` is needed); the path is "
                  "relative to the folder of the scenario file"),
            field("size", &SceneTable::size,
                  "width and height of the area that a picture used as a map shows"),
            field("world", &SceneTable::world, "Stage world file, instead of a map"),
            field("world_path", &SceneTable::world_path,
                  "further folders to search for includes and bitmaps of the world"),
            field("bitmaps", &SceneTable::bitmaps,
                  "\"OLD=NEW\": the bitmap NEW is read wherever the world names the bitmap OLD"),
            field("lenient", &SceneTable::lenient,
                  "true: a missing include or bitmap of the world causes a notice; false: it "
                  "causes an error"),
            field("floor_height", &SceneTable::floor_height, positive,
                  "height of one storey, from which the number of floors between two antennas is "
                  "computed; if not given, floors are not counted"),
            field("wall_height", &SceneTable::wall_height, positive,
                  "height of the walls whose material has no `height`; if not given, these walls "
                  "have no upper end"));
    }
};

/// Reads [scene]; does not load the map.
/// @throws InputError at the first mistake
SceneTable read_scene(const Value& value);
/// Converts a scene to a table [scene], with every default except `lenient`: the inverse of
/// read_scene().
Table scene_document(const SceneTable& scene);

/// Options for reading the Stage world of the scene, from keys of [scene].
/// @param file  path of the scenario file; search folders are relative to its folder
WorldOptions world_options(const SceneTable& scene, const std::string& file);

/// Scene of the map or of the floors; null for an open field. A file NAME.materials.toml beside a
/// map adds materials for that map, after the scenario's materials.
/// @param file     scenario file; maps are relative to its folder
/// @param notices  receives notices about materials that no wall has although a map has their grey
/// level
/// @throws InputError at the line of the scenario, followed by the error of the map
std::shared_ptr<const Scene> load_map(const SceneTable& scene, const std::string& file,
                                      std::vector<std::string>& notices);

/// Scene of the walls of a Stage world; null if the world has no walls.
/// @param world    the Stage world, already read
/// @param notices  receives notices about the world's walls
/// @throws InputError with the position in the world file
std::shared_ptr<const Scene> load_walls(const SceneTable& scene, const std::string& file,
                                        const WorldFile& world, std::vector<std::string>& notices);

/// Doors of a scene, with their materials.
std::vector<Door> doors_of(const SceneTable& scene);
/// Changes of a scene during the run, when its doors open and close; empty without doors.
/// @param open  scene with all doors open, from load_map() or load_walls()
/// @throws InputError for a door that lies off the map, or on two storeys
std::vector<SceneChange> load_doors(const SceneTable& scene,
                                    const std::shared_ptr<const Scene>& open);

/// Checks that a scene has no doors. Used by commands that examine links in a fixed scene.
/// @param who  name of the command or method, for the error message
/// @throws InputError at the first door
void refuse_doors(const SceneTable& scene, std::string_view who);

}  // namespace rovernet
