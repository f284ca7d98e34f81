// SPDX-License-Identifier: MIT
#include "experiment/scenario.hpp"

#include "experiment/toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>

namespace rovernet {
namespace {

template <class Visitor>
void for_each_parameters(PropagationModels& parameters, Visitor&& visit) {
    std::apply([&](auto&... each) { (visit(each), ...); }, parameters);
}

std::vector<std::string> model_names() {
    std::vector<std::string> names;
    for_each_model([&]<class M>() { names.emplace_back(M::name); });
    return names;
}

/// The name becomes a folder's.
void check_run_name(TableReader& document, const std::string& name) {
    if (!name.empty() && name.front() != '.' && name.find('/') == std::string::npos) return;
    const Value* given = document.take("scenario")->table()->find("name");
    throw InputError(given->where, fmt::format("name: found {}; expected a name for a folder: not "
                                               "empty, no \"/\", no \".\" in front",
                                               given->description()));
}

/// Keys of any listed model may stand here, so that a sweep can swap the model; each is checked.
void read_propagation(const Value& value, PropagationTable& out, const Location& at) {
    TableReader table(value, "[propagation]");
    if (const Value* model = table.take("model")) {
        out.model = read_choice(*model, "propagation model", model_names());
    }
    std::size_t index = 0;
    for_each_parameters(out.parameters, [&]<class M>(M& model) {
        table.read_fields(model);
        const bool chosen = index++ == out.model;
        for_each_field<M>([&](const auto& f) {
            const auto number = number_in(model.*f.member);
            if (chosen && number && *number != *number) {
                throw InputError(at, fmt::format("propagation model \"{}\" needs the key \"{}\", "
                                                 "{}; for example {} = \"50 m\"",
                                                 M::name, f.name, f.meaning, f.name));
            }
        });
    });
    table.reject_unknown();
}

void check_times(const Value& value, const std::vector<Duration>& times) {
    const bool later =
        std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) == times.end();
    if (times.front() >= Duration{0} && later) return;
    throw InputError(value.where, "times: expected times >= 0 s, each later than the one before");
}

MoveTable read_move(const Value& value) {
    TableReader table(value, "move");
    const Value* model = table.take("model");
    if (!model) table.missing("model", "move = { model = \"goal\", to = [\"5 m\", \"9 m\"] }");
    MoveTable move;
    move.where = value.where;
    const auto fill = [&](auto parameters) {
        table.read_fields(parameters);
        table.reject_unknown();
        move.model = std::move(parameters);
    };
    switch (read_choice(*model, "movement model",
                        std::vector<std::string>(move_models.begin(), move_models.end()))) {
        case 0: fill(FixedTable{}); break;
        case 1: fill(WaypointsTable{}); break;
        default: fill(GoalTable{}); break;
    }
    if (const auto* waypoints = std::get_if<WaypointsTable>(&move.model)) {
        if (waypoints->path.empty()) {
            table.missing("path", "path = [[\"5 m\", \"3 m\"], [\"5 m\", \"9 m\"]]");
        }
        if (waypoints->times && waypoints->times->size() != waypoints->path.size()) {
            throw InputError(table.take("times")->where,
                             fmt::format("times: found {} for a path of {} places; expected one "
                                         "each",
                                         waypoints->times->size(), waypoints->path.size()));
        }
        if (waypoints->times) check_times(*table.take("times"), *waypoints->times);
    }
    if (const auto* goal = std::get_if<GoalTable>(&move.model)) {
        if (goal->to && !goal->among.empty()) table.only_one_of("to", "among");
        if (!goal->to && goal->among.empty()) {
            table.missing("to", "to = [\"5 m\", \"9 m\"], or among = [...]");
        }
    }
    return move;
}

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

OnReceiveTable read_on_receive(const Value& value) {
    TableReader table(value, "on_receive");
    OnReceiveTable reaction;
    table.read("payload", reaction.payload);
    table.read("once", reaction.once);
    if (const Value* move = table.take("move")) reaction.move = read_move(*move);
    table.reject_unknown();
    if (!reaction.move) table.missing("move", "move = { model = \"goal\", to = [...] }");
    return reaction;
}

void check_name(const Value& value, const std::string& name) {
    if (name.empty() || name.find_first_of(".\"\n") != std::string::npos) {
        throw InputError(value.where, fmt::format("name: found {}; expected a name, without dots, "
                                                  "quotes or line breaks",
                                                  value.description()));
    }
}

RobotTable read_robot(const Value& value, const Scenario& scenario) {
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
    if (!robot.at && !robot.place) {
        table.missing("at", "at = [\"2 m\", \"3 m\"], or place = { ... }");
    }
    table.read("radius", robot.radius, non_negative);
    robot.radio = scenario.radio;
    if (const Value* radio = table.take("radio")) {
        TableReader own(*radio, "robot's radio");
        robot.radio_where = radio->where;
        own.read_fields(robot.radio);
        own.reject_unknown();
    }
    if (const Value* propagation = table.take("propagation")) {
        robot.propagation = scenario.propagation;
        robot.propagation_where = propagation->where;
        read_propagation(*propagation, *robot.propagation, propagation->where);
    }
    if (const Value* move = table.take("move")) robot.move = read_move(*move);
    if (const Value* react = table.take("on_receive")) robot.on_receive = read_on_receive(*react);
    for (auto* times : {&robot.off, &robot.on}) {
        const bool off = times == &robot.off;
        table.read(off ? "off" : "on", *times);
        for (const Duration t : *times) {
            if (t >= Duration{0}) continue;
            throw InputError(table.take(off ? "off" : "on")->where,
                             fmt::format("{}: found a time before 0 s; expected times of the run",
                                         off ? "off" : "on"));
        }
    }
    table.reject_unknown();
    return robot;
}

void read_start(const Value* start, TrafficTable& traffic, TableReader& table) {
    traffic.start = Duration{0};
    if (start && start->string() && *start->string() == "arrival") {
        traffic.start.reset();
    } else {
        table.read("start", traffic.start, non_negative);
    }
}

TrafficTable read_traffic(const Value& value) {
    TableReader table(value, "[[traffic]]");
    TrafficTable traffic;
    table.read("kind", traffic.kind);
    if (!table.read("from", traffic.from)) table.missing("from", "from = \"A\"");
    traffic.from_where = table.take("from")->where;
    const bool payload = table.read("payload", traffic.payload);
    const bool size = table.read("size", traffic.size);
    if (!payload && !size) table.missing("payload", "payload = \"F\", or size = \"64 B\"");
    read_start(table.take("start"), traffic, table);
    table.read("every", traffic.every, positive);
    table.read("stop", traffic.stop, non_negative);
    table.read("count", traffic.count, Range{.low = 1, .text = ">= 1"});
    table.reject_unknown();
    if (!traffic.every && (traffic.stop || traffic.count)) {
        table.missing("every", "every = \"3 s\": stop and count need it");
    }
    return traffic;
}

void read_study(const Value& value, StudyTable& study) {
    TableReader table(value, "[study]");
    table.read_fields(study);
    if (const Value* vary = table.take("vary")) {
        study.vary = TableReader(*vary, "[study] vary").table();
        for (const auto& entry : study.vary.entries) {
            if (entry.value.array() && !entry.value.array()->empty()) continue;
            throw InputError(
                entry.value.where,
                fmt::format("vary.\"{}\": found {}; expected a list of values, such as "
                            "vary.\"propagation.model\" = [\"friis\", \"itu_indoor\"]",
                            entry.key,
                            entry.value.array() ? "an empty list" : entry.value.description()));
        }
    }
    table.reject_unknown();
}

void check_names(const Scenario& scenario) {
    std::map<std::string, const RobotTable*, std::less<>> names;
    const auto add = [&](const std::string& name, const RobotTable& robot) {
        const auto [first, added] = names.emplace(name, &robot);
        if (added) return;
        throw InputError(robot.where, fmt::format("two robots are named \"{}\"; the other is at "
                                                  "{}; give each a name of its own",
                                                  name, first->second->where.text()));
    };
    for (const auto& robot : scenario.robots) {
        for (int i = 0; i < robot.count.value_or(1); ++i) {
            add(robot.count ? fmt::format("{}{}", robot.name, i) : robot.name, robot);
        }
    }
    for (const auto& traffic : scenario.traffic) {
        if (names.contains(traffic.from)) continue;
        std::vector<std::string> candidates;
        for (const auto& [name, robot] : names) {
            if (candidates.size() < 1000) candidates.push_back(name);
        }
        std::string near = did_you_mean(traffic.from, candidates);
        for (const auto& robot : scenario.robots) {
            if (robot.count && robot.name == traffic.from) {
                near = fmt::format("its robots are named {}0 to {}{}", robot.name, robot.name,
                                   *robot.count - 1);
            }
        }
        throw InputError(traffic.from_where,
                         fmt::format("from: there is no robot \"{}\"; expected the name of a "
                                     "[[robot]]{}{}",
                                     traffic.from, near.empty() ? "" : "; ", near));
    }
}

template <class T>
std::vector<T> read_list(TableReader& document, std::string_view key, auto&& read_item) {
    std::vector<T> list;
    const Value* value = document.take(key);
    if (!value) return list;
    if (!value->array()) {
        throw InputError(value->where, fmt::format("{}: found {}; expected [[{}]]", key,
                                                   value->description(), key));
    }
    for (const auto& item : *value->array()) list.push_back(read_item(item));
    return list;
}

template <Described T>
void read_section(TableReader& document, std::string_view key, T& out) {
    const Value* value = document.take(key);
    if (!value) return;
    TableReader table(*value, fmt::format("[{}]", key));
    table.read_fields(out);
    table.reject_unknown();
}

void read_scene(TableReader& document, Scenario& out) {
    read_section(document, "scene", out.scene);
    const Value* scene = document.take("scene");
    if (!scene) return;
    const Value* map = scene->table()->find("map");
    out.map_where = map ? map->where : scene->where;
    if (out.scene.size && !out.scene.map) {
        throw InputError(scene->table()->find("size")->where,
                         "size: found a size without a map; expected also map = \"office.png\"");
    }
    if (out.scene.size && out.scene.size->size() != 2) {
        throw InputError(scene->table()->find("size")->where,
                         "size: expected a width and a height, such as [\"40 m\", \"20 m\"]");
    }
    for (const Meters side : out.scene.size.value_or(std::vector<Meters>{})) {
        if (positive.contains(side.value)) continue;
        throw InputError(scene->table()->find("size")->where, "size: expected lengths > 0");
    }
}

void read_routing(TableReader& document, RoutingTable& out) {
    const Value* value = document.take("routing");
    if (!value) return;
    TableReader table(*value, "[routing]");
    table.read("protocol", out.protocol);
    table.read_fields(out.flood);
    table.reject_unknown();
}

}  // namespace

Propagation PropagationTable::make() const {
    std::optional<Propagation> made;
    std::size_t index = 0;
    std::apply(
        [&](const auto&... each) {
            ((index++ == model ? (void)(made.emplace(each)) : void()), ...);
        },
        parameters);
    return std::move(*made);
}

Propagation median_propagation(const Value& value) {
    PropagationTable table;
    read_propagation(value, table, value.where);
    std::get<LogDistance>(table.parameters).sigma = Db{0};
    return table.make();
}

Scenario read_scenario(const Value& value, const std::string& file) {
    Scenario out;
    out.file = file;
    TableReader document(value, "the scenario");
    read_section(document, "scenario", out.scenario);
    check_run_name(document, out.scenario.name);
    read_scene(document, out);
    read_section(document, "radio", out.radio);
    read_section(document, "medium", out.medium);
    out.propagation_where = value.where;
    if (const Value* propagation = document.take("propagation")) {
        out.propagation_where = propagation->where;
        read_propagation(*propagation, out.propagation, propagation->where);
    }
    read_section(document, "reception", out.reception);
    out.robots = read_list<RobotTable>(document, "robot",
                                       [&](const Value& v) { return read_robot(v, out); });
    read_routing(document, out.routing);
    out.traffic = read_list<TrafficTable>(document, "traffic", read_traffic);
    read_section(document, "trace", out.trace);
    if (const Value* study = document.take("study")) read_study(*study, out.study);
    document.reject_unknown();
    if (out.robots.empty()) document.missing("robot", "[[robot]] with a name and a place");
    check_names(out);
    return out;
}

Scenario load_scenario(const std::string& path, const std::vector<std::string>& options) {
    Value document = read_toml(path);
    for (const auto& option : options) set_option(*document.table(), option);
    return read_scenario(document, path);
}

}  // namespace rovernet
