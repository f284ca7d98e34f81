// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/value.hpp"
#include "scene/material.hpp"
#include "scene/scene.hpp"
#include "scene/stage/worldfile.hpp"
#include "sim/error.hpp"
#include "sim/fields.hpp"
#include "sim/units.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// [scene.materials] NAME = { ... }: what walls of a grey level or a colour are made of.
struct MaterialTable {
    std::optional<int> grey;                ///< mean of red, green and blue, 0 ... 255, or ...
    std::optional<std::vector<int>> greys;  ///< ... from the first to the second of these
    std::optional<std::string> color;       ///< of a Stage model
    std::optional<Db> per_crossing;
    std::optional<DbPerMeter> per_metre;
    std::optional<ItuMaterial> itu;
    std::optional<Meters> thickness;
    std::optional<Meters> height;
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
    /// It is what walls of this grey level are made of.
    bool has_grey(int level) const {
        return grey == level || (greys && (*greys)[0] <= level && level <= (*greys)[1]);
    }
};

/// [scene]
struct SceneTable {
    std::optional<std::string> map;           ///< ROS map.yaml, or a picture with a `size`
    std::optional<std::vector<Meters>> size;  ///< [m] width and height of a picture
    std::optional<std::string> world;         ///< Stage world, instead of a map
    std::optional<std::vector<std::string>> world_path;
    std::optional<std::vector<std::string>> bitmaps;
    bool lenient = false;
    Meters floor_height{3};
    std::optional<Meters> wall_height;
    std::vector<MaterialTable> materials = {};
    Location map_where = {};

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
            field("floor_height", &SceneTable::floor_height, positive, "of one storey"),
            field("wall_height", &SceneTable::wall_height, positive,
                  "of walls whose material has none of its own; endless if not given"));
    }
};

/// Reads [scene]. @throws InputError
SceneTable read_scene(const Value& value);
/// The reverse.
Table scene_document(const SceneTable& scene);

/// How the scene's world is to be read; folders relative to the scenario `file`.
WorldOptions world_options(const SceneTable& scene, const std::string& file);

/// The scene's map; null for an open field.
/// @param file     of the scenario
/// @param notices  appended: materials that make no wall, though the map has their grey
/// @throws InputError naming the scenario's line, then the map's own error
std::shared_ptr<const Scene> load_map(const SceneTable& scene, const std::string& file,
                                      std::vector<std::string>& notices);

/// The walls of the scene's world; null if it has none.
/// @param notices  appended
/// @throws InputError with its place in the world
std::shared_ptr<const Scene> load_walls(const SceneTable& scene, const std::string& file,
                                        const WorldFile& world, std::vector<std::string>& notices);

}  // namespace rovernet
