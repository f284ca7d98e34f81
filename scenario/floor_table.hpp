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

/// ceiling = { ... } of a floor: the slab between its storey and the storey above. The loss is
/// given by `per_crossing`, or by `itu` and `thickness`; without these the propagation model
/// decides it.
struct CeilingTable {
    /// Loss of the ceiling [dB].
    std::optional<Db> per_crossing;
    /// Material of the ceiling, a slab of `thickness` [m], by ITU-R P.2040.
    std::optional<ItuMaterial> itu;
    std::optional<Meters> thickness;

    static constexpr auto fields() {
        return describe(
            field("per_crossing", &CeilingTable::per_crossing, non_negative, "loss of the ceiling"),
            field("itu", &CeilingTable::itu, "a slab of this material of ITU-R P.2040"),
            field("thickness", &CeilingTable::thickness, positive, "of the slab"));
    }
};

/// [[scene.floor]]: a floor, and the map of the storey above it.
struct FloorTable {
    /// Height of the floor [m]: z of robots that drive on it.
    Meters height{0};
    /// ROS map.yaml, or a picture with a `size`; relative to the scenario file.
    std::string map;
    /// Width and height of a picture [m]: two lengths > 0.
    std::optional<std::vector<Meters>> size;
    /// Ceiling of the storey on this floor; none: the propagation model decides its loss.
    std::optional<CeilingTable> ceiling = {};
    /// File position of the key `map`, for error messages.
    Location map_where = {};

    static constexpr auto fields() {
        return describe(field("height", &FloorTable::height, "of the floor: z of robots on it"),
                        field("map", &FloorTable::map,
                              "ROS map.yaml, or a picture with a size; relative to the file"),
                        field("size", &FloorTable::size, "width and height of a picture"));
    }
};

/// Reads [[scene.floor]]; does not load the maps.
/// @throws InputError at the first mistake
std::vector<FloorTable> read_floors(const Value& value);
/// Tables [[scene.floor]] from which read_floors() reads the same floors.
Array floors_document(const std::vector<FloorTable>& floors);

/// Checks the size of a picture used as a map. @throws InputError at `where`
void check_map_size(const std::vector<Meters>& size, const Location& where);

}  // namespace rovernet
