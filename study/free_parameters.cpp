// SPDX-License-Identifier: MIT
#include "study/free_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace rovernet {
namespace {

constexpr double far_from_zero = 500;  // [dB]

constexpr std::array all_free{
    FreeParameter{.model = "disc", .key = "range", .unit = "m"},
    FreeParameter{.model = "itu_indoor", .key = "coefficient", .base = 30},
    FreeParameter{.model = "log_distance", .key = "exponent", .base = 2},
    FreeParameter{.model = "log_distance", .key = "excess", .unit = "dB", .base = far_from_zero},
    FreeParameter{.model = "multi_wall", .key = "exponent", .base = 2},
    FreeParameter{.model = "multi_wall", .key = "excess", .unit = "dB", .base = far_from_zero},
    FreeParameter{.model = "multi_wall", .key = "light_wall", .unit = "dB", .non_negative = true},
    FreeParameter{.model = "multi_wall", .key = "heavy_wall", .unit = "dB", .non_negative = true},
    FreeParameter{.model = "raytrace_2007", .key = "coefficient", .base = 30},
    FreeParameter{.model = "raytrace_2007", .key = "wall_factor", .unit = "", .non_negative = true},
};

}  // namespace

std::vector<FreeParameter> free_parameters(std::string_view model) {
    std::vector<FreeParameter> out;
    std::copy_if(all_free.begin(), all_free.end(), std::back_inserter(out),
                 [&](const FreeParameter& p) { return p.model == model; });
    return out;
}

Propagation model_with(const Scenario& scenario, std::string_view model,
                       const std::map<std::string, double>& values) {
    Table table;
    table.set("model", model);
    for (const FreeParameter& p : free_parameters(model)) {
        const auto value = values.find(std::string(p.key));
        if (value == values.end()) continue;
        table.set(p.key, p.unit.empty() ? Value(value->second)
                                        : Value(fmt::format("{} {}", value->second, p.unit)));
    }
    PropagationTable propagation = scenario.propagation;
    Value document(std::move(table));
    document.where = scenario.propagation_where;
    read_propagation(document, propagation);
    return propagation.make().median();
}

std::vector<LinearLoss> linear_losses(const KnownLinks& known, const Scenario& scenario,
                                      std::string_view model, std::span<const FreeParameter> free) {
    std::map<std::string, double> bases;
    for (const FreeParameter& p : free) bases[std::string(p.key)] = p.base;
    const Propagation at_base = model_with(scenario, model, bases);
    std::vector<Propagation> moved;
    for (const FreeParameter& p : free) {
        auto values = bases;
        values[std::string(p.key)] += 1;
        moved.push_back(model_with(scenario, model, values));
    }
    std::vector<LinearLoss> out;
    for (const KnownLink& link : known.links) {
        at_base.check_frequency(link.frequency);
        LinearLoss loss{.offset = known.loss_by(at_base, link), .columns = {}};
        const double there = loss.offset;
        for (std::size_t j = 0; j < free.size(); ++j) {
            loss.columns.push_back(known.loss_by(moved[j], link) - there);
            loss.offset -= free[j].base * loss.columns[j];
        }
        out.push_back(std::move(loss));
    }
    return out;
}

}  // namespace rovernet
