// SPDX-License-Identifier: MIT
#include "cli/display/picture_output.hpp"
#include "cli/scenes/scene_commands.hpp"
#include "cli/terminal/playing.hpp"
#include "cli/tools/tool_commands.hpp"
#include "experiment/reports/link_report.hpp"
#include "experiment/reports/loss_table.hpp"
#include "experiment/run.hpp"
#include "experiment/version.hpp"
#include "pictures/chart/budget_chart.hpp"
#include "scenario/document/json.hpp"
#include "scenario/document/simulator_names.hpp"
#include "scenario/model_names.hpp"
#include "scenario/schema.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace rovernet::cli {
namespace {

void print_paths(const Rays::Paths& paths) {
    fmt::print("  {} paths", paths.found);
    if (paths.left_out > 0) {
        fmt::print("; max_paths leaves out the weakest {}, which makes the loss {:.3g} dB higher",
                   paths.left_out, paths.too_high.value);
    }
    fmt::print("\n\n");
}

void print_state(const LinkReport& r) {
    fmt::print("\n{} -> {} is {}\n", r.from, r.to, r.up ? "up" : "down: " + r.why_down);
}

void print_budget(const LinkReport& r) {
    fmt::print("{} -> {} at {:.9g} s: {:.3f} m, model {}\n\n", r.from, r.to, seconds(r.at),
               r.distance_m, r.model);
    for (std::size_t i = 0; i < r.walls.size(); ++i) {
        fmt::print("  {} from {:8.3f} m to {:8.3f} m: {:.3f} m", r.materials[i], r.walls[i].entry,
                   r.walls[i].exit, r.walls[i].length);
        if (!r.wall_losses.empty()) fmt::print(", {:.3f} dB", r.wall_losses[i].value);
        fmt::print("\n");
    }
    if (r.wall_m > 0) {
        fmt::print("  {:.3f} m of wall in all{}\n\n", r.wall_m,
                   r.ignores_walls ? "; model " + r.model + " ignores walls" : "");
    }
    if (r.ceilings > 0 || r.floors > 0) {
        const std::size_t number = r.ceilings > 0 ? r.ceilings : r.floors;
        fmt::print("  {} {}{}, {:.3f} dB\n\n", number, r.ceilings > 0 ? "ceiling" : "floor",
                   number == 1 ? "" : "s", (r.ceilings > 0 ? r.ceiling_loss : r.floor_loss).value);
    }
    if (r.rays) print_paths(*r.rays);
    if (r.range) {
        fmt::print("  {:<28} {:10.3f} m\n  {:<28} {:10.3f} m\n", "distance", r.distance_m, "range",
                   r.range->value);
        return print_state(r);
    }
    const auto line = [](std::string_view what, double value, std::string_view unit) {
        fmt::print("  {:<28} {:+10.3f} {}\n", what, value, unit);
    };
    line("power", r.sender.power.value, "dBm");
    for (const BudgetTerm& term : budget_terms(r, false)) line(term.what, term.change, "dB");
    line("received power", r.received.value, "dBm");
    line("receiver's sensitivity", r.receiver.sensitivity.value, "dBm");
    line("margin", r.margin.value, "dB");
    print_state(r);
}

/// Chart of a link's budget: without terms that change nothing.
BudgetChart chart_of(const LinkReport& r) {
    if (r.range) {
        throw std::invalid_argument(fmt::format(
            "the model {} has only a range and computes no levels, so there is no budget to draw; "
            "expected a model that computes levels",
            r.model));
    }
    BudgetChart chart{.title = fmt::format("{} to {} at {:.9g} s: {}", r.from, r.to, seconds(r.at),
                                           r.up ? "the link is up" : "no link, " + r.why_down),
                      .subtitle = fmt::format("{:.1f} m, model {}", r.distance_m, r.model),
                      .power = r.sender.power.value,
                      .sensitivity = r.receiver.sensitivity.value};
    for (const BudgetTerm& term : budget_terms(r, true)) {
        if (term.change != 0) chart.steps.push_back({term.what, term.change});
    }
    return chart;
}

std::string text_of(const Value& value) {
    if (value.string()) return *value.string();
    if (std::holds_alternative<std::monostate>(value.data)) return "-";
    const std::string text = to_json(value);
    return text.substr(0, text.size() - 1);
}

/// The keys of a model of list_models(), a line each.
void print_parameters(const Table& model) {
    for (const Value& parameter : *model.find("parameters")->array()) {
        const Table& p = *parameter.table();
        fmt::print("    {:<20} {:<10} {:<6} {}\n", text_of(*p.find("name")),
                   text_of(*p.find("default")), text_of(*p.find("range")),
                   text_of(*p.find("meaning")));
    }
}

/// Entry of list_models() with this name. @throws std::invalid_argument if there is none
Value model_called(const std::string& name) {
    std::vector<std::string> names;
    for (const Value& model : list_models()) {
        names.push_back(text_of(*model.table()->find("name")));
        if (names.back() == name) return model;
    }
    const std::string known = simulator_name_hint(name, names);
    const std::string near = known.empty() ? did_you_mean(name, names) : known;
    throw std::invalid_argument(
        fmt::format("unknown propagation model \"{}\"; expected one of {}{}{}", name,
                    fmt::join(names, ", "), near.empty() ? "" : "; ", near));
}

}  // namespace

void link(const LinkArguments& a) {
    if (!a.out.empty()) check_picture_name(a.out);
    const Scenario scenario = scenario_of(a);
    const Time at = time_in(scenario, a.at);
    const auto report = [&] {
        Playing playing(a.file, at);
        return report_link(scenario, a.from, a.to, at, playing.tell());
    }();
    if (!a.out.empty()) {
        write_picture(a.out, budget_chart_svg(chart_of(report)));
    } else if (a.json) {
        fmt::print("{}", to_json(link_document(report)));
    } else {
        print_budget(report);
    }
}

void models(const ModelsArguments& a) {
    const Array list = a.name.empty() ? list_models() : Array{model_called(a.name)};
    const Array variations = a.name.empty() ? list_variations() : Array{};
    if (a.json) {
        Table table;
        table.set("models", list);
        table.set("variations", variations);
        fmt::print("{}", to_json(table));
        return;
    }
    for (const Value& model : list) {
        fmt::print("{}\n", text_of(*model.table()->find("name")));
        print_parameters(*model.table());
    }
    for (const Value& variation : variations) {
        const std::string name = text_of(*variation.table()->find("name"));
        fmt::print("{}, in addition to any model; keys of the table [{}]:\n", name, name);
        print_parameters(*variation.table());
    }
}

void print_schema(const PrintArguments&) { fmt::print("{}", to_json(scenario_schema())); }

void print_version(const PrintArguments& a) {
    Table built = build_provenance();
    const Table names = model_names();
    if (a.json) {
        built.set("models", names);
        fmt::print("{}", to_json(built));
        return;
    }
    fmt::print("rovernet {}\n", version());
    for (const auto& entry : built.entries) {
        if (entry.key != "version") fmt::print("{:<11} {}\n", entry.key, text_of(entry.value));
    }
    for (const auto& entry : names.entries) {
        std::vector<std::string> words;
        for (const Value& name : *entry.value.array()) words.push_back(text_of(name));
        fmt::print("{:<11} {}\n", entry.key, fmt::join(words, ", "));
    }
}

}  // namespace rovernet::cli
