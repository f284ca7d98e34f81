// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "sim/error.hpp"
#include "sim/fields.hpp"
#include "sim/geometry.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <optional>
#include <string>
#include <vector>

// Doors of a scene, which close and open during a run:
//
//     [[scene.door]]
//     name = "lab"
//     from = ["12 m", "4 m"]
//     to = ["13 m", "4 m"]
//     material = "wood"
//     closes = ["10 s"]
//     opens = ["20 s"]

namespace rovernet {

/// [[scene.door]]: a piece of wall that is present only while the door is closed. See Door.
struct DoorTable {
    /// Name of the door in messages to the user; none: messages show the door's number.
    std::optional<std::string> name = {};
    /// End points of the door's centre line [m].
    Vec3 from, to;
    Meters thickness{0.05};
    /// Name of a material of [scene.materials]; none: the propagation model decides the loss.
    std::optional<std::string> material = {};
    /// Times since the start of the run [ns] at which the door closes and opens. The door is open
    /// at the start.
    std::vector<Duration> closes = {}, opens = {};
    /// File positions of the [[scene.door]] table and of its key `material`, for error messages.
    Location where = {}, material_where = {};

    static constexpr auto fields() {
        return describe(field("name", &DoorTable::name, "name of the door, for error messages"),
                        field("from", &DoorTable::from, "position of one end of the door"),
                        field("to", &DoorTable::to, "position of the other end of the door"),
                        field("thickness", &DoorTable::thickness, positive,
                              "thickness of the door; half of the thickness lies on each side of "
                              "the line between the two ends"),
                        field("material", &DoorTable::material,
                              "material of the door: a name from [scene.materials]"),
                        field("closes", &DoorTable::closes, "times at which the door closes"),
                        field("opens", &DoorTable::opens, "times at which the door opens"));
    }
};

/// Reads [[scene.door]]; does not check doors against the map.
/// @throws InputError at the first mistake
std::vector<DoorTable> read_doors(const Value& value);
/// Converts doors to tables [[scene.door]]: the inverse of read_doors().
Array doors_document(const std::vector<DoorTable>& doors);

}  // namespace rovernet
