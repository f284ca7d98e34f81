// SPDX-License-Identifier: MIT
#include "scenario/scenario.hpp"
#include "scenario/tables/reader.hpp"

namespace rovernet {
namespace {

template <Described T>
Table section(const T& value) {
    Table table;
    append_fields(table, value);
    return table;
}

Table section(const Radio& radio) {
    Table table;
    append_fields(table, radio);
    append_fields(table, radio.labels);
    return table;
}

Table section(const TrafficTable& traffic) {
    Table table;
    table.set("kind", to_value(traffic.kind));
    table.set("name", traffic.name);
    table.set("from", traffic.from);
    if (traffic.to) table.set("to", *traffic.to);
    if (traffic.hops) table.set("hops", *traffic.hops);
    if (traffic.saturate) table.set("saturate", true);
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
    document.set("scene", scene_document(scenario.scene));
    document.set("radio", section(scenario.radio));
    document.set("medium", section(scenario.medium));
    document.set("propagation", chosen_document(scenario.propagation));
    if (scenario.shadowing.model != ShadowingModel::none) {
        document.set("shadowing", section(scenario.shadowing));
    }
    if (scenario.fading.model != FadingModel::none) {
        document.set("fading", section(scenario.fading));
    }
    document.set("reception", whole_document(scenario.reception));
    Table access = whole_document(scenario.access);
    if (scenario.arp.arp) append_fields(access, scenario.arp);
    document.set("access", std::move(access));
    document.set("links", section(scenario.links));
    document.set("movement", section(scenario.movement));
    Array robots;
    for (const auto& robot : scenario.robots) robots.emplace_back(robot_document(robot, scenario));
    if (!robots.empty()) document.set("robot", std::move(robots));
    document.set("routing", chosen_document(scenario.routing, "protocol"));
    Array traffic;
    for (const auto& each : scenario.traffic) traffic.emplace_back(section(each));
    if (!traffic.empty()) document.set("traffic", std::move(traffic));
    document.set("trace", section(scenario.trace));
    document.set("metrics", section(scenario.metrics));
    document.set("study", study_document(scenario.study));
    return document;
}

}  // namespace rovernet
