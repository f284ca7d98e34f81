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

/// ceiling = { ... } of a floor: what stands between its storey and the one above. Its loss is
/// given by `per_crossing`, or by `itu` and `thickness`; if not, it follows the propagation model.
struct CeilingTable {
    /// Loss of the ceiling [dB].
    std::optional<Db> per_crossing;
    /// Material of ITU-R P.2040 of which it is a slab, of `thickness` [m].
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
    /// Ceiling of its storey; none: it follows the propagation model.
    std::optional<CeilingTable> ceiling = {};
    /// Place of the key `map`.
    Location map_where = {};

    static constexpr auto fields() {
        return describe(field("height", &FloorTable::height, "of the floor: z of robots on it"),
                        field("map", &FloorTable::map,
                              "ROS map.yaml, or a PNG or PGM with a size; relative to the file"),
                        field("size", &FloorTable::size, "width and height of a picture"));
    }
};

/// Reads [[scene.floor]]; the maps themselves are not looked at.
/// @throws InputError at the first mistake
std::vector<FloorTable> read_floors(const Value& value);
/// Tables that read back as the same floors.
Array floors_document(const std::vector<FloorTable>& floors);

/// Checks the size of a picture used as a map. @throws InputError at `where`
void check_map_size(const std::vector<Meters>& size, const Location& where);

}  // namespace rovernet
