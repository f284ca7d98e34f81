// SPDX-License-Identifier: MIT
#include "scenario/floor_table.hpp"

#include "scenario/tables/reader.hpp"

#include <fmt/format.h>

#include <utility>

namespace rovernet {
namespace {

CeilingTable read_ceiling(const Value& value) {
    TableReader table(value, "ceiling");
    table.expect<CeilingTable>();
    CeilingTable ceiling;
    table.read_fields(ceiling);
    if (ceiling.itu && !ceiling.thickness) table.missing("thickness", "thickness = \"0.2 m\"");
    if (ceiling.thickness && !ceiling.itu) table.missing("itu", "itu = \"concrete\"");
    if (ceiling.itu && ceiling.per_crossing) table.only_one_of("itu", "per_crossing");
    return ceiling;
}

FloorTable read_floor(const Value& value) {
    TableReader table(value, "[[scene.floor]]");
    table.expect<FloorTable>({"ceiling"});
    FloorTable floor;
    table.read_fields(floor);
    if (const Value* ceiling = table.take("ceiling")) floor.ceiling = read_ceiling(*ceiling);
    if (!table.table().find("map")) table.missing("map", "map = \"ground.png\"");
    if (!table.table().find("height")) table.missing("height", "height = \"3 m\"");
    floor.map_where = table.take("map")->where;
    if (floor.size) check_map_size(*floor.size, table.take("size")->where);
    return floor;
}

/// Checks that each floor lies above the one before.
void check_order(const std::vector<FloorTable>& floors, const Array& list) {
    for (std::size_t i = 1; i < floors.size(); ++i) {
        const double below = floors[i - 1].height.value, height = floors[i].height.value;
        if (height > below) continue;
        throw InputError(list[i].table()->find("height")->where,
                         fmt::format("height: found {} m after a floor at {} m; expected the "
                                     "floors in order, from the lowest to the highest",
                                     height, below));
    }
}

}  // namespace

void check_map_size(const std::vector<Meters>& size, const Location& where) {
    if (size.size() != 2) {
        throw InputError(where,
                         "size: expected a width and a height, such as [\"40 m\", \"20 m\"]");
    }
    for (const Meters side : size) {
        if (!positive.contains(side.value)) throw InputError(where, "size: expected lengths > 0");
    }
}

std::vector<FloorTable> read_floors(const Value& value) {
    const Array* list = value.array();
    if (!list || list->empty()) {
        throw InputError(
            value.where,
            fmt::format(
                "floor: found {}; expected a list of tables, each with the header [[scene.floor]]",
                value.description()));
    }
    std::vector<FloorTable> floors;
    for (const Value& each : *list) floors.push_back(read_floor(each));
    check_order(floors, *list);
    if (!floors.back().ceiling) return floors;
    throw InputError(list->back().table()->find("ceiling")->where,
                     "ceiling: found this key at the highest floor, but a ceiling lies between two "
                     "storeys; expected this key only at lower floors");
}

Array floors_document(const std::vector<FloorTable>& floors) {
    Array list;
    for (const FloorTable& floor : floors) {
        Table table;
        append_fields(table, floor);
        if (floor.ceiling) {
            Table ceiling;
            append_fields(ceiling, *floor.ceiling);
            table.set("ceiling", std::move(ceiling));
        }
        list.emplace_back(std::move(table));
    }
    return list;
}

}  // namespace rovernet
