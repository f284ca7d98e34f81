// SPDX-License-Identifier: MIT
#include "experiment/reports/loss_table.hpp"

#include "models/variation/fading.hpp"
#include "models/variation/shadowing.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario.hpp"
#include "scenario/tables/read_value.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace rovernet {
namespace {

Value option_value(const std::string& option, const std::string& text) {
    Value value{text};
    value.where = {fmt::format("{} {}", option, text), 0, 0, true};
    return value;
}

/// Wall as thick as asked for, across the way of every link that is longer than it.
Scene scene_with_wall(Meters wall) {
    if (wall.value == 0) return Scene{};
    return Scene{OccupancyGrid{.columns = 1,
                               .rows = 1,
                               .cell_width = wall.value,
                               .cell_height = 1,
                               .origin = {0, -0.5},
                               .yaw = 0,
                               .cells = {Cell::occupied}}};
}

template <class M>
Value default_of(const M& model, const auto& f) {
    const auto& member = model.*f.member;
    if constexpr (requires { member.has_value(); }) {
        return member ? to_value(*member) : Value();
    } else {
        const auto number = number_in(member);
        return number && *number != *number ? Value() : to_value(member);
    }
}

/// Name of a choice, and what it takes: its keys with their defaults.
template <class M>
Table described_choice(std::string_view name) {
    Table table;
    table.set("name", name);
    Array parameters;
    for_each_field<M>([&](const auto& f) {
        Table parameter;
        parameter.set("name", f.name);
        parameter.set("default", default_of(M{}, f));
        parameter.set("range", f.range.text == any.text ? "" : f.range.text);
        parameter.set("meaning", f.meaning);
        parameters.emplace_back(std::move(parameter));
    });
    table.set("parameters", std::move(parameters));
    return table;
}

}  // namespace

Hertz option_frequency(const std::string& option, const std::string& text) {
    Hertz f;
    const Value value = option_value(option, text);
    read_value(value, "frequency", f);
    if (!positive.contains(f.value)) throw InputError(value.where, "expected a frequency > 0");
    return f;
}

Meters option_length(const std::string& option, const std::string& text) {
    Meters length;
    const Value value = option_value(option, text);
    read_value(value, "length", length);
    if (!non_negative.contains(length.value)) {
        throw InputError(value.where, "expected a length >= 0");
    }
    return length;
}

Duration option_time(const std::string& option, const std::string& text) {
    Duration t;
    const Value value = option_value(option, text);
    read_value(value, "time", t);
    if (t < Duration{0}) throw InputError(value.where, "expected a time >= 0");
    return t;
}

std::vector<LossRow> loss_table(const std::string& model,
                                const std::vector<std::string>& parameters, Hertz frequency,
                                const std::vector<Meters>& distances, LossAntennas heights,
                                Meters wall) {
    const Location option{"loss " + model, 0, 0, true};
    Value document{Table{}};
    document.where = option;
    Value name{model};
    name.where = option;
    document.table()->set("model", std::move(name));
    for (const auto& parameter : parameters) set_option(document, parameter, parameter);
    const Propagation propagation = median_propagation(document);
    try {
        propagation.check_frequency(frequency);
    } catch (const std::invalid_argument& error) {
        throw InputError(option, error.what());
    }

    const Scene scene = scene_with_wall(wall);
    std::vector<LossRow> rows;
    for (const Meters d : distances) {
        if (wall > d) {
            throw InputError(option, fmt::format("{} m of wall do not fit into a path of {} m; "
                                                 "expected a shorter wall, or a larger distance",
                                                 wall.value, d.value));
        }
        const LinkBatch link{
            .frequency = frequency, .from = {0, 0, heights.from.value}, .scene = &scene};
        rows.push_back({d, {propagation.loss_to({d.value, 0, heights.to.value}, link, 1)}});
    }
    return rows;
}

Array list_models() {
    Array models;
    for_each_model([&]<class M>() { models.emplace_back(described_choice<M>(M::name)); });
    return models;
}

Array list_variations() {
    return {Value(described_choice<Shadowing>("shadowing")),
            Value(described_choice<Fading>("fading"))};
}

}  // namespace rovernet
