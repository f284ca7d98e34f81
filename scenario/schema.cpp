// SPDX-License-Identifier: MIT
#include "scenario/schema.hpp"

#include "scenario/scenario.hpp"
#include "scenario/tables/value_schema.hpp"

#include <string>
#include <string_view>
#include <utility>

namespace rovernet {
namespace {

/// Table that chooses a model of a list, with the keys of all models of the list.
template <class Choice, Described... Common>
Table choice_schema(std::string_view key) {
    Table keys;
    add_key(keys, key, schema_of_words(listed(Choice::names())),
            "name of the chosen model or protocol");
    Choice::for_each_type([&]<class M>() { add_keys<M>(keys, M::name); });
    (add_keys<Common>(keys), ...);
    return schema_of_table(std::move(keys));
}

/// Table `move`: it has the keys of its model alone.
Table move_schema() {
    Array models;
    [&]<class... Models>(std::variant<Models...>*) {
        const auto add = [&]<class M>(std::type_identity<M>) {
            Table keys;
            Array required{"model"};
            add_key(keys, "model", schema_of_words({M::name}), "movement model");
            add_keys<M>(keys);
            if constexpr (LedModel<M>) {
                add_key(keys, "leader", schema_of_type("string"),
                        "name of the robot that this robot follows");
                required.emplace_back("leader");
            }
            models.emplace_back(schema_of_table(std::move(keys), required));
        };
        (add(std::type_identity<Models>{}), ...);
    }(static_cast<MoveModels*>(nullptr));
    Table schema;
    schema.set("anyOf", std::move(models));
    return schema;
}

/// One table, or a list of tables.
Table one_or_more(const Table& schema) { return schema_of_either(schema, schema_of_list(schema)); }

Table reaction_schema(Trigger trigger) {
    Table keys;
    add_keys_if<ReactionTable>(
        keys, {}, [&](std::string_view key) { return ReactionTable::has_key(trigger, key); });
    add_key(keys, "move", move_schema(), "movement that the robot begins");
    return schema_of_table(std::move(keys), trigger == Trigger::on_time ? Array{"time"} : Array{});
}

/// Keys of a radio, and its labels.
Table radio_schema() {
    Table keys;
    add_keys<Radio>(keys);
    add_keys<RadioLabels>(keys);
    return schema_of_table(std::move(keys));
}

Table robot_schema() {
    Table keys;
    add_keys<RobotTable>(keys);
    add_key(keys, "place", table_schema<PlaceTable>(), "random start position");
    add_key(keys, "move", move_schema(), "movement");
    Table scanner;
    add_keys<RangeFinder>(scanner);
    add_keys<Scanner>(scanner);
    add_key(keys, "scan", one_or_more(schema_of_table(std::move(scanner))),
            "range finders of the robot");
    add_key(keys, "role", schema_of_words(listed(all_roles())),
            "role of the robot in the routing protocol");
    add_key(keys, "radio", radio_schema(), "keys that replace those of [radio] for this robot");
    add_key(keys, "propagation", choice_schema<PropagationTable>("model"),
            "propagation model of the frames that this robot sends");
    for (std::size_t i = 0; i < EnumNames<Trigger>::values.size(); ++i) {
        const auto trigger = static_cast<Trigger>(i);
        add_key(keys, name_of(trigger), one_or_more(reaction_schema(trigger)), "reaction");
    }
    return schema_of_table(std::move(keys), {"name"});
}

Table scene_schema() {
    Table keys;
    add_keys<SceneTable>(keys);
    Table floor;
    add_keys<FloorTable>(floor);
    add_key(floor, "ceiling", table_schema<CeilingTable>(),
            "ceiling between this storey and the storey above");
    Table floors = schema_of_list(schema_of_table(std::move(floor), {"map", "height"}), 1);
    add_key(keys, "floor", std::move(floors),
            "floors of the building, from the lowest to the highest");
    add_key(keys, "door", schema_of_list(table_schema<DoorTable>({"from", "to", "closes"})),
            "doors, which are walls while they are closed");
    Table materials = schema_of_type("object");
    materials.set("additionalProperties", table_schema<MaterialTable>());
    add_key(keys, "materials", std::move(materials), "materials of walls, by name");
    return schema_of_table(std::move(keys));
}

Table traffic_schema() {
    Table keys;
    add_keys<TrafficTable>(keys);
    add_key(
        keys, "start",
        schema_of_either(schema_of_quantity(Dimension::time, false),
                         schema_of_words({TrafficTable::at_arrival})),
        "time of the first message, or \"arrival\": the sender reaches the end of its movement");
    return schema_of_table(std::move(keys), {"from"});
}

/// [traffic] or [[traffic]]: flows, or files of flows.
Table all_traffic_schema() {
    Table keys;
    add_key(keys, "file", schema_of_type("string"), "traffic file of ns-2");
    const Table file = schema_of_table(std::move(keys), {"file"});
    return schema_of_either(schema_of_list(schema_of_either(traffic_schema(), file)), file);
}

/// [study] vary: values by path, in lists and ranges. A path with dots is a table in a table: the
/// schema of the inner table is that of [study] vary itself.
Table vary_schema() {
    const Table amount = schema_of_either(schema_of_type("number"), schema_of_type("string"));
    Table range;
    for (const char* key : {"from", "to", "step"}) range.set(key, amount);
    Table longer_path;
    longer_path.set("$ref", "#/properties/study/properties/vary");
    Table list = schema_of_type("array");
    list.set("minItems", 1);
    Table values = schema_of_either(
        schema_of_either(std::move(list),
                         schema_of_table(std::move(range), {"from", "to", "step"})),
        std::move(longer_path));
    Table schema = schema_of_type("object");
    schema.set("additionalProperties", std::move(values));
    return schema;
}

Table study_schema() {
    Table keys;
    add_keys<StudyTable>(keys);
    add_key(
        keys, "warmup",
        schema_of_either(schema_of_quantity(Dimension::time, false), schema_of_words({"mser5"})),
        "first part of each run, which the metrics leave out");
    add_key(keys, "vary", vary_schema(),
            "values of each key that the study varies: vary.\"radio.power\" = [...]");
    add_key(keys, "zip", value_schema<decltype(StudyTable::zip)>(any),
            "groups of varied keys that change together: the i-th value of one key is combined "
            "only with the i-th values of the others");
    add_key(keys, "exclude", schema_of_list(schema_of_type("object")),
            "combinations of values that the study leaves out");
    return schema_of_table(std::move(keys));
}

}  // namespace

Table scenario_schema() {
    Table keys;
    keys.set("scenario", table_schema<ScenarioTable>());
    keys.set("scene", scene_schema());
    keys.set("radio", radio_schema());
    keys.set("medium", table_schema<MediumTable>());
    keys.set("propagation", choice_schema<PropagationTable>("model"));
    keys.set("shadowing", table_schema<Shadowing>({"model"}));
    keys.set("fading", table_schema<Fading>({"model"}));
    keys.set("reception", choice_schema<ReceptionTable>("model"));
    keys.set("access", choice_schema<AccessTable, ArpSettings>("model"));
    keys.set("links", table_schema<LinksTable>());
    keys.set("movement", table_schema<MovementTable>());
    keys.set("robot", schema_of_list(robot_schema()));
    keys.set("routing", choice_schema<RoutingTable>("protocol"));
    keys.set("traffic", all_traffic_schema());
    keys.set("trace", table_schema<TraceTable>());
    keys.set("metrics", table_schema<MetricsTable>());
    keys.set("study", study_schema());
    Table schema;
    schema.set("$schema", "http://json-schema.org/draft-04/schema#");
    schema.set("title", "Scenario of rovernet");
    const Table root = schema_of_table(std::move(keys));
    for (const Entry& entry : root.entries) schema.set(entry.key, entry.value);
    return schema;
}

}  // namespace rovernet
