// SPDX-License-Identifier: MIT
#include "experiment/scenario.hpp"

#include <fmt/format.h>

namespace rovernet {
namespace {

template <Described T>
Table section(const T& value) {
    Table table;
    append_fields(table, value);
    return table;
}

/// The chosen model's parameters, and those of others that differ from their defaults.
Table section(const PropagationTable& propagation) {
    Table table;
    std::size_t index = 0;
    const auto append = [&]<class M>(const M& model) {
        if (index++ != propagation.model) return;
        table.set("model", M::name);
        append_fields(table, model);
    };
    std::apply([&](const auto&... each) { (append(each), ...); }, propagation.parameters);
    const auto append_others = [&]<class M>(const M& model) {
        Table given, defaults;
        append_fields(given, model);
        append_fields(defaults, M{});
        for (const auto& entry : given.entries) {
            const Value* usual = defaults.find(entry.key);
            const bool is_unset = entry.value.string() && entry.value.string()->starts_with("nan");
            if (is_unset || table.find(entry.key)) continue;
            if (usual && usual->data.index() == entry.value.data.index() &&
                usual->description() == entry.value.description()) {
                continue;
            }
            table.set(entry.key, entry.value);
        }
    };
    std::apply([&](const auto&... each) { (append_others(each), ...); }, propagation.parameters);
    return table;
}

Table section(const MoveTable& move) {
    Table table;
    table.set("model", move_models[move.model.index()]);
    std::visit([&](const auto& parameters) { append_fields(table, parameters); }, move.model);
    std::erase_if(table.entries, [](const Entry& entry) {
        return entry.value.array() && entry.value.array()->empty();
    });
    return table;
}

Table section(const PlaceTable& place) {
    Table table;
    append_fields(table, place);
    std::erase_if(table.entries, [](const Entry& entry) {
        return entry.value.array() && entry.value.array()->empty();
    });
    return table;
}

/// The keys of a robot's radio that differ from [radio].
Table difference(const Radio& own, const Radio& usual) {
    Table table;
    const auto append = [&](std::string_view name, const auto& value) {
        if constexpr (requires { value.has_value(); }) {
            if (value) table.set(name, to_value(*value));
        } else {
            table.set(name, to_value(value));
        }
    };
    for_each_field<Radio>([&](const auto& f) {
        if (own.*f.member != usual.*f.member) append(f.name, own.*f.member);
    });
    return table;
}

Table section(const RobotTable& robot, const Scenario& scenario) {
    Table table;
    table.set("name", robot.name);
    if (robot.count) table.set("count", *robot.count);
    if (robot.at) table.set("at", to_value(*robot.at));
    if (robot.place) table.set("place", section(*robot.place));
    table.set("radius", to_value(robot.radius));
    Table radio = difference(robot.radio, scenario.radio);
    if (!radio.entries.empty()) table.set("radio", std::move(radio));
    if (robot.propagation) table.set("propagation", section(*robot.propagation));
    table.set("move", section(robot.move));
    if (robot.on_receive) {
        Table reaction;
        reaction.set("payload", robot.on_receive->payload);
        reaction.set("once", robot.on_receive->once);
        reaction.set("move", section(*robot.on_receive->move));
        table.set("on_receive", std::move(reaction));
    }
    if (!robot.off.empty()) table.set("off", to_value(robot.off));
    if (!robot.on.empty()) table.set("on", to_value(robot.on));
    return table;
}

Table section(const TrafficTable& traffic) {
    Table table;
    table.set("kind", to_value(traffic.kind));
    table.set("from", traffic.from);
    table.set("payload", traffic.payload);
    if (traffic.size) table.set("size", to_value(*traffic.size));
    table.set("start", traffic.start ? to_value(*traffic.start) : Value("arrival"));
    if (traffic.every) table.set("every", to_value(*traffic.every));
    if (traffic.stop) table.set("stop", to_value(*traffic.stop));
    if (traffic.count) table.set("count", *traffic.count);
    return table;
}

}  // namespace

Table to_document(const Scenario& scenario) {
    Table document;
    document.set("scenario", section(scenario.scenario));
    document.set("scene", section(scenario.scene));
    document.set("radio", section(scenario.radio));
    document.set("medium", section(scenario.medium));
    document.set("propagation", section(scenario.propagation));
    document.set("reception", section(scenario.reception));
    Array robots;
    for (const auto& robot : scenario.robots) robots.emplace_back(section(robot, scenario));
    document.set("robot", std::move(robots));
    Table routing;
    routing.set("protocol", to_value(scenario.routing.protocol));
    append_fields(routing, scenario.routing.flood);
    document.set("routing", std::move(routing));
    Array traffic;
    for (const auto& each : scenario.traffic) traffic.emplace_back(section(each));
    if (!traffic.empty()) document.set("traffic", std::move(traffic));
    document.set("trace", section(scenario.trace));
    Table study = section(scenario.study);
    if (!scenario.study.vary.entries.empty()) study.set("vary", scenario.study.vary);
    document.set("study", std::move(study));
    return document;
}

}  // namespace rovernet
