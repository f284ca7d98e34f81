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

/// [[scene.door]]: a piece of wall that is there at times only. See Door.
struct DoorTable {
    /// Name in messages; none: its number.
    std::optional<std::string> name = {};
    /// Ends of its middle line [m].
    Vec3 from, to;
    Meters thickness{0.05};
    /// Name of a material of [scene.materials]; none: it follows the propagation model.
    std::optional<std::string> material = {};
    /// Times at which it closes and opens [ns]; it is open at first.
    std::vector<Duration> closes = {}, opens = {};
    /// Places of the table and of its material.
    Location where = {}, material_where = {};

    static constexpr auto fields() {
        return describe(
            field("name", &DoorTable::name, "as messages call it"),
            field("from", &DoorTable::from, "one end"), field("to", &DoorTable::to, "other end"),
            field("thickness", &DoorTable::thickness, positive, "half of it on each side"),
            field("material", &DoorTable::material, "of [scene.materials]"),
            field("closes", &DoorTable::closes, "times at which it closes"),
            field("opens", &DoorTable::opens, "times at which it opens"));
    }
};

/// Reads [[scene.door]]; the map is not looked at.
/// @throws InputError at the first mistake
std::vector<DoorTable> read_doors(const Value& value);
/// Tables that read back as the same doors.
Array doors_document(const std::vector<DoorTable>& doors);

}  // namespace rovernet
