// SPDX-License-Identifier: MIT
#include "scenario/door_table.hpp"

#include "scenario/tables/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rovernet {
namespace {

/// Checks the times of a door: of the run, and none at which it both closes and opens.
void check_times(const DoorTable& door, TableReader& table) {
    for (const char* key : {"closes", "opens"}) {
        for (const Duration t : key == std::string_view("closes") ? door.closes : door.opens) {
            if (t >= Duration{0}) continue;
            throw InputError(
                table.take(key)->where,
                fmt::format("{}: found a time before 0 s; expected simulated times from 0 s on",
                            key));
        }
    }
    for (const Duration t : door.opens) {
        if (std::find(door.closes.begin(), door.closes.end(), t) == door.closes.end()) continue;
        throw InputError(table.take("opens")->where,
                         fmt::format("opens: found {} s, but the door also closes at this time; "
                                     "expected a different time",
                                     seconds(t)));
    }
}

DoorTable read_door(const Value& value) {
    TableReader table(value, "[[scene.door]]");
    table.expect<DoorTable>();
    DoorTable door;
    door.where = value.where;
    table.read_fields(door);
    if (door.name) check_printable(*table.take("name"), "name", *door.name);
    if (!table.table().find("from")) table.missing("from", "from = [\"12 m\", \"4 m\"]");
    if (!table.table().find("to")) table.missing("to", "to = [\"13 m\", \"4 m\"]");
    if (door.closes.empty()) table.missing("closes", "closes = [\"10 s\"]");
    if (door.from.x == door.to.x && door.from.y == door.to.y) {
        throw InputError(
            table.take("to")->where,
            "to: found the same place as in the key \"from\"; expected the other end of the door");
    }
    if (door.material) door.material_where = table.take("material")->where;
    check_times(door, table);
    return door;
}

}  // namespace

std::vector<DoorTable> read_doors(const Value& value) {
    const Array* list = value.array();
    if (!list) {
        throw InputError(
            value.where,
            fmt::format(
                "door: found {}; expected a list of tables, each with the header [[scene.door]]",
                value.description()));
    }
    std::vector<DoorTable> doors;
    for (const Value& each : *list) doors.push_back(read_door(each));
    return doors;
}

Array doors_document(const std::vector<DoorTable>& doors) {
    Array list;
    for (const DoorTable& door : doors) {
        Table table;
        append_fields(table, door);
        if (door.opens.empty()) {
            std::erase_if(table.entries, [](const Entry& e) { return e.key == "opens"; });
        }
        list.emplace_back(std::move(table));
    }
    return list;
}

}  // namespace rovernet
