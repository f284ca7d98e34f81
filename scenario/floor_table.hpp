// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "scene/materials/p2040.hpp"
#include "sim/error.hpp"
#include "sim/fields.hpp"
#include "sim/units.hpp"

#include <optional>
#include <string>
#include <vector>

// Floors of a building of several storeys, from the lowest up:
//
//     [[scene.floor]]
//     height = "0 m"
//     map = "ground.png"
//     size = ["20 m", "12 m"]
//     ceiling = { itu = "concrete", thickness = "0.2 m" }
//
//     [[scene.floor]]
//     height = "3 m"
//     map = "upper.png"
//     size = ["20 m", "12 m"]

namespace rovernet {

/// ceiling = { ... } of a floor: the slab between the floor's storey and the storey above. Its loss
/// is given by `per_crossing`, or by `itu` and `thickness`. If none of these keys is given, the
/// propagation model determines the loss.
struct CeilingTable {
    /// Loss of a signal that crosses the ceiling [dB]; none: `itu` or the model determines it.
    std::optional<Db> per_crossing;
    /// Material of ITU-R P.2040, and thickness [m]. The ceiling has the loss of a slab of this
    /// material and thickness.
    std::optional<ItuMaterial> itu;
    std::optional<Meters> thickness;

    static constexpr auto fields() {
        return describe(field("per_crossing", &CeilingTable::per_crossing, non_negative,
                              "loss of a path through the ceiling"),
                        field("itu", &CeilingTable::itu,
                              "material of the ceiling, from ITU-R P.2040, which gives the loss; "
                              "needs `thickness`"),
                        field("thickness", &CeilingTable::thickness, positive,
                              "thickness of the ceiling, for `itu`"));
    }
};

/// [[scene.floor]]: a floor, and the map of the storey above it.
struct FloorTable {
    /// Height of the floor [m]: z of robots that drive on it.
    Meters height{0};
    /// Path of the map, relative to the scenario file: a ROS map.yaml, or a picture with a `size`.
    std::string map;
    /// Width and height of a map that is a picture [m]: two lengths > 0.
    std::optional<std::vector<Meters>> size;
    /// Ceiling of the storey on this floor; none: the propagation model decides its loss.
    std::optional<CeilingTable> ceiling = {};
    /// File position of the key `map`, for error messages.
    Location map_where = {};

    static constexpr auto fields() {
        return describe(
            field("height", &FloorTable::height,
                  "height of the floor: the z coordinate of robots on this floor"),
            field("map", &FloorTable::map,
                  "map of the floor: a map.yaml of ROS, or a picture (then `size` is needed); the "
                  "path is relative to the folder of the scenario file"),
            field("size", &FloorTable::size,
                  "width and height of the area that the picture shows; only for a picture"));
    }
};

/// Reads [[scene.floor]]; does not load the maps.
/// @throws InputError at the first mistake
std::vector<FloorTable> read_floors(const Value& value);
/// Converts floors to tables [[scene.floor]]: the inverse of read_floors().
Array floors_document(const std::vector<FloorTable>& floors);

/// Checks the size of a picture used as a map: it must be a width and a height [m], both > 0.
/// @throws InputError at `where`
void check_map_size(const std::vector<Meters>& size, const Location& where);

}  // namespace rovernet
