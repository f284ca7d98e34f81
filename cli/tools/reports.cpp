// SPDX-License-Identifier: MIT
#include "cli/scenes/scene_commands.hpp"
#include "cli/terminal/playing.hpp"
#include "cli/tools/tool_commands.hpp"
#include "experiment/reports/link_report.hpp"
#include "experiment/reports/loss_table.hpp"
#include "experiment/run.hpp"
#include "experiment/version.hpp"
#include "models/propagation/disc.hpp"
#include "scenario/document/json.hpp"
#include "scenario/model_names.hpp"
#include "scenario/schema.hpp"

#include <fmt/format.h>

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
        const bool sees_walls = !r.wall_losses.empty() || r.rays;
        fmt::print("  {:.3f} m of wall in all{}\n\n", r.wall_m,
                   sees_walls ? "" : "; model " + r.model + " does not see walls");
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
    line("sender's antenna gain", r.sender.antenna_gain.value, "dB");
    if (r.sender.is_directional()) line("sender's pattern", r.sender_pattern.value, "dB");
    line("sender's cable loss", -r.sender.cable_loss.value, "dB");
    const Db shadowing = r.shadowing.value_or(Db{0});
    line("path loss", -(r.path_loss - shadowing).value, "dB");
    if (r.shadowing) line("shadowing", -shadowing.value, "dB");
    line("receiver's antenna gain", r.receiver.antenna_gain.value, "dB");
    if (r.receiver.is_directional()) line("receiver's pattern", r.receiver_pattern.value, "dB");
    line("receiver's cable loss", -r.receiver.cable_loss.value, "dB");
    line("received power", r.received.value, "dBm");
    line("receiver's sensitivity", r.receiver.sensitivity.value, "dBm");
    line("margin", r.margin.value, "dB");
    print_state(r);
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

}  // namespace

void loss(const LossArguments& a) {
    const Hertz frequency = option_frequency("--frequency", a.frequency);
    std::vector<Meters> distances;
    for (const auto& text : a.distances) distances.push_back(option_length("--distance", text));
    const Meters wall = a.wall ? option_length("--wall", *a.wall) : Meters{0};
    if (a.heights.size() > 2) {
        throw InputError({"--heights", 0, 0, true},
                         fmt::format("found {} heights; expected one height for both antennas, or "
                                     "two, for the sender and the receiver: 1.5,0.3",
                                     a.heights.size()));
    }
    const Meters standard = Radio{}.antenna_height;
    const LossAntennas heights{
        a.heights.empty() ? standard : option_length("--heights", a.heights.front()),
        a.heights.empty() ? standard : option_length("--heights", a.heights.back())};
    const bool has_levels = a.model != Disc::name;
    const auto rows = loss_table(a.model, a.parameters, frequency, distances, heights, wall);
    if (!a.json) {
        fmt::print("{:>14} {:>14}\n", "distance [m]", has_levels ? "loss [dB]" : "link");
        for (const auto& [d, l] : rows) {
            const std::string loss = has_levels       ? fmt::format("{:.6f}", l.value)
                                     : l.value == 0.0 ? "in range"
                                                      : "out of range";
            fmt::print("{:>14} {:>14}\n", d.value, loss);
        }
        return;
    }
    Table table;
    table.set("model", a.model);
    table.set("frequency_hz", frequency.value);
    if (!a.heights.empty()) {
        table.set("from_height_m", heights.from.value);
        table.set("to_height_m", heights.to.value);
    }
    Array list;
    for (const auto& [d, l] : rows) {
        Table row;
        row.set("distance_m", d.value);
        row.set("loss_db", has_levels ? Value(l.value) : Value());
        if (!has_levels) row.set("in_range", l.value == 0.0);
        list.emplace_back(std::move(row));
    }
    table.set("rows", std::move(list));
    fmt::print("{}", to_json(table));
}

void link(const LinkArguments& a) {
    const Scenario scenario = scenario_of(a);
    const Time at = time_in(scenario, a.at);
    const auto report = [&] {
        Playing playing(a.file, at);
        return report_link(scenario, a.from, a.to, at, playing.tell());
    }();
    if (a.json) {
        fmt::print("{}", to_json(link_document(report)));
    } else {
        print_budget(report);
    }
}

void models(const PrintArguments& a) {
    const Array list = list_models(), variations = list_variations();
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
        fmt::print("{}, over any model: [{}]\n", name, name);
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
