// SPDX-License-Identifier: MIT
#include "scenario/robot_table.hpp"

#include "mobility/movement.hpp"
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
    PlaceTable place;
    place.where = value.where;
    table.read_fields(place);
    table.reject_unknown();
    if (place.model == PlaceTable::Model::uniform && place.area.size() != 2) {
        table.missing("area", "area = [[\"0 m\", \"0 m\"], [\"100 m\", \"50 m\"]]");
    }
    if (place.model == PlaceTable::Model::choice && place.points.empty()) {
        table.missing("points", "points = [[\"5 m\", \"3 m\"], [\"15 m\", \"3 m\"]]");
    }
    return place;
}

/// Checks the destination of a message: `to` needs `send`, and "sender" needs on_receive.
void check_receiver(const ReactionTable& reaction, TableReader& table) {
    if (!reaction.to) return;
    if (!reaction.send) table.missing("send", "send = \"F\": to needs it");
    if (*reaction.to != ReactionTable::sender || reaction.trigger == Trigger::on_receive) return;
    throw InputError(reaction.to_where,
                     fmt::format("to: found \"sender\" in {}, where no message came; expected the "
                                 "name of a robot, or on_receive",
                                 name_of(reaction.trigger)));
}

ReactionTable read_reaction(const Value& value, Trigger trigger) {
    TableReader table(value, std::string(name_of(trigger)));
    ReactionTable reaction;
    reaction.trigger = trigger;
    reaction.where = value.where;
    const bool receives = trigger == Trigger::on_receive;
    if (receives) table.read("payload", reaction.payload);
    if (receives) {
        table.read("hops", reaction.hops,
                   Range{.low = 1, .high = 65535, .text = "from 1 to 65535"});
    }
    if (receives || trigger == Trigger::on_link_lost) {
        if (table.read("from", reaction.from)) reaction.from_where = table.take("from")->where;
    }
    if (trigger == Trigger::on_time) {
        if (!table.read("time", reaction.time, non_negative)) {
            table.missing("time", "time = \"10 s\"");
        }
    } else {
        table.read("once", reaction.once);
    }
    if (const Value* move = table.take("move")) reaction.move = read_move(*move, true);
    table.read("send", reaction.send);
    if (table.read("to", reaction.to)) reaction.to_where = table.take("to")->where;
    table.read("size", reaction.size, sizes_of_messages);
    table.read("stop", reaction.stop);
    table.reject_unknown();
    check_receiver(reaction, table);
    if (reaction.stop && reaction.move) table.only_one_of("move", "stop");
    if (reaction.size && !reaction.send) table.missing("send", "send = \"F\": size needs it");
    if (!reaction.move && !reaction.send && !reaction.stop) {
        table.missing("move",
                      "move = { model = \"goal\", to = [...] }, send = \"F\" or stop = true");
    }
    return reaction;
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

void check_name(const Value& value, const std::string& name) {
    check_printable(value, "name", name);
    if (name.empty() || name.find_first_of(".\"") != std::string::npos) {
        throw InputError(value.where, fmt::format("name: found {}; expected a name, without dots "
                                                  "and quotes",
                                                  value.description()));
    }
}

void read_switching(TableReader& table, RobotTable& robot) {
    for (auto* times : {&robot.off, &robot.on}) {
        const char* key = times == &robot.off ? "off" : "on";
        if (!table.read(key, *times)) continue;
        (times == &robot.off ? robot.off_where : robot.on_where) = table.take(key)->where;
        for (const Duration t : *times) {
            if (t >= Duration{0}) continue;
            throw InputError(
                table.take(key)->where,
                fmt::format("{}: found a time before 0 s; expected times of the run", key));
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

Table reaction_document(const ReactionTable& reaction) {
    Table table;
    if (reaction.trigger == Trigger::on_receive) table.set("payload", reaction.payload);
    if (reaction.from) table.set("from", *reaction.from);
    if (reaction.hops) table.set("hops", *reaction.hops);
    if (reaction.trigger == Trigger::on_time) {
        table.set("time", to_value(reaction.time));
    } else {
        table.set("once", reaction.once);
    }
    if (reaction.move) table.set("move", move_document(*reaction.move));
    if (reaction.send) table.set("send", *reaction.send);
    if (reaction.to) table.set("to", *reaction.to);
    if (reaction.size) table.set("size", to_value(*reaction.size));
    if (reaction.stop) table.set("stop", true);
    return table;
}

void append_reactions(Table& table, const RobotTable& robot) {
    for (std::size_t i = 0; i < EnumNames<Trigger>::values.size(); ++i) {
        Array list;
        for (const ReactionTable& reaction : robot.reactions) {
            if (reaction.trigger == static_cast<Trigger>(i)) {
                list.emplace_back(reaction_document(reaction));
            }
        }
        if (list.empty()) continue;
        const auto key = name_of(static_cast<Trigger>(i));
        if (list.size() == 1)
            table.set(key, std::move(list.front()));
        else
            table.set(key, std::move(list));
    }
}

Table place_document(const PlaceTable& place) {
    Table table;
    append_fields(table, place);
    std::erase_if(table.entries, [](const Entry& entry) {
        return entry.value.array() && entry.value.array()->empty();
    });
    return table;
}

}  // namespace

void read_radio(const Value& value, const std::string& name, Radio& out, RadioPlaces& places) {
    TableReader table(value, name);
    table.read_fields(out);
    table.read_fields(out.labels);
    table.reject_unknown();
    for (const char* label : {"essid", "ip", "netmask", "mac"}) {
        if (const Value* text = table.take(label)) check_printable(*text, label, *text->string());
    }
    const Value* pattern = table.take("antenna_pattern");
    const Value* antenna = pattern ? pattern : table.take("antenna");
    located(antenna ? antenna->where : value.where, [&] { check_antenna(out); });
    const auto find = [&](std::string_view key, Location& where) {
        if (const Value* key_value = table.take(key)) where = key_value->where;
    };
    find("sensitivity", places.sensitivity);
    find("frequency", places.frequency);
    find("rate", places.rate);
    find("ip", places.ip);
    find("netmask", places.netmask);
    find("mac", places.mac);
}

RobotTable read_robot(const Value& value, const Scenario& scenario, bool needs_place) {
    TableReader table(value, "[[robot]]");
    RobotTable robot;
    robot.where = robot.at_where = robot.radio_where = robot.propagation_where = value.where;
    if (!table.read("name", robot.name)) table.missing("name", "name = \"A\"");
    check_name(*table.take("name"), robot.name);
    table.read("count", robot.count, Range{.low = 1, .high = 10e6, .text = "from 1 to 10,000,000"});
    if (const Value* at = table.take("at")) robot.at_where = at->where;
    table.read("at", robot.at);
    if (const Value* place = table.take("place")) robot.place = read_place(*place);
    if (robot.at && robot.place) table.only_one_of("at", "place");
    const bool placed = robot.at || robot.place;
    table.read("heading", robot.heading);
    table.read("radius", robot.radius, non_negative);
    table.read("top_speed", robot.top_speed, positive);
    table.read("turn_rate", robot.turn_rate, turn_rates);
    if (const Value* move = table.take("move")) robot.move = read_move(*move, placed);
    if (const Value* scan = table.take("scan")) robot.scan = read_scanners(*scan);
    if (!placed && needs_place && !robot.move.draws_place()) {
        table.missing("at", "at = [\"2 m\", \"3 m\"], or place = { ... }");
    }
    if (const Value* role = table.take("role")) {
        const auto roles = all_roles();
        robot.role = roles[read_choice(*role, "role", roles)];
    }
    read_air(table, robot, scenario);
    read_reactions(table, robot);
    read_switching(table, robot);
    table.reject_unknown();
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
    append_reactions(table, robot);
    if (!robot.off.empty()) table.set("off", to_value(robot.off));
    if (!robot.on.empty()) table.set("on", to_value(robot.on));
    return table;
}

}  // namespace rovernet
