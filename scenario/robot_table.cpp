// SPDX-License-Identifier: MIT
#include "scenario/robot_table.hpp"

#include "models/link_gain.hpp"
#include "scenario/document/located.hpp"
#include "scenario/scenario.hpp"
#include "scenario/tables/reader.hpp"
#include "scenario/tables/scan_table.hpp"

#include <fmt/format.h>

namespace rovernet {
namespace {

PlaceTable read_place(const Value& value) {
    TableReader table(value, "place");
    table.expect<PlaceTable>();
    PlaceTable place;
    place.where = value.where;
    table.read_fields(place);
    if (place.model == PlaceTable::Model::uniform && place.area.size() != 2) {
        table.missing("area", "area = [[\"0 m\", \"0 m\"], [\"100 m\", \"50 m\"]]");
    }
    if (place.model == PlaceTable::Model::choice && place.points.empty()) {
        table.missing("points", "points = [[\"5 m\", \"3 m\"], [\"15 m\", \"3 m\"]]");
    }
    return place;
}

/// Declares the keys of [[robot]], so that a misspelt one is reported before values are read.
void expect_keys(TableReader& table) {
    for_each_field<RobotTable>([&](const auto& f) { table.take(f.name); });
    for (const char* key : {"place", "move", "scan", "role", "radio", "propagation"}) {
        table.take(key);
    }
    for (const std::string_view trigger : EnumNames<Trigger>::values) table.take(trigger);
    table.reject_unknown();
}

void read_reactions(TableReader& table, RobotTable& robot) {
    for (std::size_t i = 0; i < EnumNames<Trigger>::values.size(); ++i) {
        const auto trigger = static_cast<Trigger>(i);
        const Value* value = table.take(name_of(trigger));
        if (!value) continue;
        if (!value->array()) {
            robot.reactions.push_back(read_reaction(*value, trigger));
            continue;
        }
        for (const Value& each : *value->array()) {
            robot.reactions.push_back(read_reaction(each, trigger));
        }
    }
}

/// @param may_have_dots  whether a movement file has the name
void check_name(const Value& value, const std::string& name, bool may_have_dots) {
    check_printable(value, "name", name);
    const bool has_dot = !may_have_dots && name.find('.') != std::string::npos;
    if (!name.empty() && !has_dot && name.find('"') == std::string::npos) return;
    throw InputError(
        value.where,
        fmt::format("name: found {}; expected a name, without dots and quotes{}",
                    value.description(),
                    has_dot ? "; only robots of a movement file may have names with dots" : ""));
}

void check_switching(TableReader& table, RobotTable& robot) {
    for (auto* times : {&robot.off, &robot.on}) {
        const char* key = times == &robot.off ? "off" : "on";
        if (!table.table().find(key)) continue;
        (times == &robot.off ? robot.off_where : robot.on_where) = table.take(key)->where;
        for (const Duration t : *times) {
            if (t >= Duration{0}) continue;
            throw InputError(
                table.take(key)->where,
                fmt::format("{}: found a time before 0 s; expected simulated times from 0 s on",
                            key));
        }
    }
}

void read_air(TableReader& table, RobotTable& robot, const Scenario& scenario) {
    robot.radio = scenario.radio;
    robot.radio_places = scenario.radio_places;
    if (const Value* radio = table.take("radio")) {
        robot.radio_where = radio->where;
        read_radio(*radio, "robot's radio", robot.radio, robot.radio_places);
    }
    if (const Value* propagation = table.take("propagation")) {
        robot.own_model = propagation->table() && propagation->table()->find("model");
        // A robot with its own model inherits no parameters of [propagation].
        robot.propagation = robot.own_model ? PropagationTable{} : scenario.propagation;
        robot.propagation_where = propagation->where;
        read_propagation(*propagation, *robot.propagation);
    }
}

template <Described T>
void append_difference(Table& table, const T& own, const T& usual) {
    for_each_field<T>([&](const auto& f) {
        if (own.*f.member != usual.*f.member) append_field(table, f.name, own.*f.member);
    });
}

/// The keys of a robot's radio that differ from [radio].
Table difference(const Radio& own, const Radio& usual) {
    Table table;
    append_difference(table, own, usual);
    append_difference(table, own.labels, usual.labels);
    return table;
}

Table place_document(const PlaceTable& place) {
    Table table;
    append_fields(table, place);
    std::erase_if(table.entries, [](const Entry& entry) {
        return entry.value.array() && entry.value.array()->empty();
    });
    return table;
}

/// Reports a robot without a place. Beside robots that a world or a movement file places, it is
/// probably meant to be one of them.
[[noreturn]] void throw_without_place(const TableReader& table, const RobotTable& robot,
                                      const std::vector<std::string>& placed) {
    if (placed.empty() || robot.count)
        table.missing("at", "at = [\"2 m\", \"3 m\"], or place = { ... }");
    const std::string near = did_you_mean(robot.name, placed);
    throw InputError(
        table.table().find("name")->where,
        fmt::format("name: no world and no movement file has a robot \"{}\"; expected the name of "
                    "one of their robots, such as \"{}\", or a new robot with the key \"at\"{}{}",
                    robot.name, placed.front(), near.empty() ? "" : "; ", near));
}

}  // namespace

void read_radio(const Value& value, const std::string& name, Radio& out, RadioPlaces& places) {
    TableReader table(value, name);
    table.expect<Radio, RadioLabels>();
    table.read_fields(out);
    table.read_fields(out.labels);
    for (const char* label : {"essid", "ip", "netmask", "mac"}) {
        if (const Value* text = table.take(label)) check_printable(*text, label, *text->string());
    }
    const Value* pattern = table.take("antenna_pattern");
    const Value* antenna = pattern ? pattern : table.take("antenna");
    located(antenna ? antenna->where : value.where, [&] { check_antenna(out); });
    const auto find = [&](std::string_view key, Location& where) {
        if (const Value* key_value = table.take(key)) where = key_value->where;
    };
    find("power", places.power);
    find("sensitivity", places.sensitivity);
    find("frequency", places.frequency);
    find("rate", places.rate);
    find("ip", places.ip);
    find("netmask", places.netmask);
    find("mac", places.mac);
}

RobotTable read_robot(const Value& value, const Scenario& scenario,
                      const std::function<bool(const RobotTable&)>& needs_place,
                      const std::vector<std::string>& placed) {
    TableReader table(value, "[[robot]]");
    expect_keys(table);
    RobotTable robot;
    robot.where = robot.at_where = robot.radio_where = robot.propagation_where = value.where;
    table.read_fields(robot);
    if (!table.table().find("name")) table.missing("name", "name = \"A\"");
    check_name(*table.take("name"), robot.name, !needs_place(robot));
    if (robot.at) robot.at_where = table.take("at")->where;
    if (const Value* place = table.take("place")) robot.place = read_place(*place);
    if (robot.at && robot.place) table.only_one_of("at", "place");
    const bool has_place = robot.at || robot.place;
    if (const Value* move = table.take("move")) robot.move = read_move(*move, has_place);
    if (const Value* scan = table.take("scan")) robot.scan = read_scanners(*scan);
    if (!has_place && needs_place(robot) && !robot.move.draws_place())
        throw_without_place(table, robot, placed);
    if (const Value* role = table.take("role")) {
        const auto roles = all_roles();
        robot.role = roles[read_choice(*role, "role", roles)];
    }
    read_air(table, robot, scenario);
    read_reactions(table, robot);
    check_switching(table, robot);
    return robot;
}

Table robot_document(const RobotTable& robot, const Scenario& scenario) {
    Table table;
    table.set("name", robot.name);
    if (robot.count) table.set("count", *robot.count);
    if (robot.at) table.set("at", to_value(*robot.at));
    if (robot.place) table.set("place", place_document(*robot.place));
    table.set("heading", to_value(robot.heading));
    table.set("radius", to_value(robot.radius));
    if (robot.top_speed) table.set("top_speed", to_value(*robot.top_speed));
    if (robot.turn_rate) table.set("turn_rate", to_value(*robot.turn_rate));
    if (robot.role) table.set("role", *robot.role);
    Table radio = difference(robot.radio, scenario.radio);
    if (!radio.entries.empty()) table.set("radio", std::move(radio));
    if (robot.propagation) table.set("propagation", chosen_document(*robot.propagation));
    table.set("move", move_document(robot.move));
    if (!robot.scan.empty()) table.set("scan", scanners_document(robot.scan));
    append_reactions(table, robot.reactions);
    if (!robot.off.empty()) table.set("off", to_value(robot.off));
    if (!robot.on.empty()) table.set("on", to_value(robot.on));
    return table;
}

}  // namespace rovernet
