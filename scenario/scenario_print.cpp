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

/// Table of the chosen protocol with its parameters.
Table routing_document(const RoutingTable& routing) {
    Table document;
    std::size_t index = 0;
    const auto append = [&]<class P>(const P& protocol) {
        if (index++ != routing.protocol) return;
        document.set("protocol", std::string(P::name));
        append_fields(document, protocol);
    };
    std::apply([&](const auto&... each) { (append(each), ...); }, routing.parameters);
    return document;
}

}  // namespace

Table propagation_document(const PropagationTable& propagation) {
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

Table to_document(const Scenario& scenario) {
    Table document;
    document.set("scenario", section(scenario.scenario));
    document.set("scene", scene_document(scenario.scene));
    document.set("radio", section(scenario.radio));
    document.set("medium", section(scenario.medium));
    document.set("propagation", propagation_document(scenario.propagation));
    if (scenario.shadowing.model != ShadowingModel::none) {
        document.set("shadowing", section(scenario.shadowing));
    }
    if (scenario.fading.model != FadingModel::none) {
        document.set("fading", section(scenario.fading));
    }
    document.set("reception", section(scenario.reception));
    document.set("access", section(scenario.access));
    document.set("links", section(scenario.links));
    document.set("movement", section(scenario.movement));
    Array robots;
    for (const auto& robot : scenario.robots) robots.emplace_back(robot_document(robot, scenario));
    if (!robots.empty()) document.set("robot", std::move(robots));
    document.set("routing", routing_document(scenario.routing));
    Array traffic;
    for (const auto& each : scenario.traffic) traffic.emplace_back(section(each));
    if (!traffic.empty()) document.set("traffic", std::move(traffic));
    document.set("trace", section(scenario.trace));
    document.set("metrics", section(scenario.metrics));
    document.set("study", study_document(scenario.study));
    return document;
}

}  // namespace rovernet
