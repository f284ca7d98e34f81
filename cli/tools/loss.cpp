// SPDX-License-Identifier: MIT
#include "cli/display/picture_output.hpp"
#include "cli/terminal/diagnostics.hpp"
#include "cli/tools/tool_commands.hpp"
#include "experiment/reports/loss_table.hpp"
#include "models/propagation/disc.hpp"
#include "pictures/chart/chart.hpp"
#include "scenario/document/json.hpp"
#include "scenario/unlikely.hpp"
#include "sim/math.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace rovernet::cli {
namespace {

/// Propagation model with its parameters, and its losses.
struct ModelLoss {
    std::string model;
    std::vector<std::string> parameters;
    std::vector<LossRow> rows;

    /// Whether the model has losses, and not only a range.
    bool has_levels() const { return model != Disc::name; }
    std::string name() const {
        return parameters.empty() ? model : fmt::format("{} {}", model, fmt::join(parameters, " "));
    }
};

/// Models of the words "MODEL KEY=VALUE ... MODEL ...".
std::vector<ModelLoss> models_of(const std::vector<std::string>& words) {
    std::vector<ModelLoss> models;
    for (const std::string& word : words) {
        if (word.find('=') == word.npos)
            models.push_back({.model = word, .parameters = {}, .rows = {}});
        else if (!models.empty())
            models.back().parameters.push_back(word);
        else
            throw std::invalid_argument(fmt::format(
                "\"{}\" is a parameter without a model before it; expected MODEL {}", word, word));
    }
    return models;
}

LossAntennas heights_of(const LossArguments& a) {
    if (a.heights.size() > 2) {
        throw InputError(
            {"--heights", 0, 0, true},
            fmt::format("found {} heights; expected one height for both antennas, or two heights, "
                        "of the sender and of the receiver, such as 1.5,0.3",
                        a.heights.size()));
    }
    const Meters standard = Radio{}.antenna_height;
    return {a.heights.empty() ? standard : option_length("--heights", a.heights.front()),
            a.heights.empty() ? standard : option_length("--heights", a.heights.back())};
}

/// Distances from the least to the largest of a list, close enough for a smooth curve over a
/// logarithmic axis.
std::vector<Meters> curve_between(const std::vector<Meters>& distances) {
    const auto [least, largest] = std::minmax_element(distances.begin(), distances.end());
    if (!(least->value > 0 && *least < *largest)) {
        throw InputError({"--distance", 0, 0, true},
                         "expected two different distances above 0 for a picture, such as 1,100");
    }
    constexpr int steps = 200;
    const double ratio = math::log(largest->value / least->value);
    std::vector<Meters> out;
    for (int i = 0; i <= steps; ++i) {
        const double share = static_cast<double>(i) / steps;
        out.push_back({least->value * math::exp(share * ratio)});
    }
    return out;
}

Table document_of(const ModelLoss& model, Hertz frequency, const LossArguments& a) {
    Table table;
    table.set("model", model.model);
    if (!model.parameters.empty())
        table.set("parameters", Array(model.parameters.begin(), model.parameters.end()));
    table.set("frequency_hz", frequency.value);
    if (!a.heights.empty()) {
        const LossAntennas heights = heights_of(a);
        table.set("from_height_m", heights.from.value);
        table.set("to_height_m", heights.to.value);
    }
    Array list;
    for (const auto& [d, l] : model.rows) {
        Table row;
        row.set("distance_m", d.value);
        row.set("loss_db", model.has_levels() ? Value(l.value) : Value());
        if (!model.has_levels()) row.set("in_range", l.value == 0.0);
        list.emplace_back(std::move(row));
    }
    table.set("rows", std::move(list));
    return table;
}

/// A line for each distance, with a column for each model.
void print_losses(const std::vector<ModelLoss>& models) {
    const auto width = [](const std::string& title) {
        constexpr std::size_t least = 14;
        return std::max(least, title.size());
    };
    const auto title = [&](const ModelLoss& m) {
        if (models.size() > 1) return m.name() + (m.has_levels() ? " [dB]" : "");
        return std::string(m.has_levels() ? "loss [dB]" : "link");
    };
    fmt::print("{:>14}", "distance [m]");
    for (const ModelLoss& m : models) fmt::print(" {:>{}}", title(m), width(title(m)));
    for (std::size_t i = 0; i < models.front().rows.size(); ++i) {
        fmt::print("\n{:>14}", models.front().rows[i].distance.value);
        for (const ModelLoss& m : models) {
            const double loss = m.rows[i].loss.value;
            const std::string text = m.has_levels() ? fmt::format("{:.6f}", loss)
                                     : loss == 0.0  ? "in range"
                                                    : "out of range";
            fmt::print(" {:>{}}", text, width(title(m)));
        }
    }
    fmt::print("\n");
}

void draw_losses(const std::vector<ModelLoss>& models, Hertz frequency, const std::string& out) {
    Chart chart{.kind = ChartKind::lines,
                .x_label = "distance [m]",
                .y_label = "path loss [dB]",
                .legend_title = "model",
                .note = fmt::format("{:g} MHz", frequency.value / 1e6),
                .log_x = true};
    for (const ModelLoss& m : models) {
        if (!m.has_levels()) {
            throw std::invalid_argument(fmt::format(
                "the model {} has only a range and computes no losses, so there is no curve to "
                "draw; expected models that compute losses",
                m.model));
        }
        ChartSeries& series = chart.series.emplace_back(ChartSeries{.name = m.name()});
        for (const auto& [d, l] : m.rows) series.points.push_back({.x = d.value, .y = l.value});
    }
    write_picture(out, chart_svg({&chart, 1}));
}

}  // namespace

void loss(const LossArguments& a) {
    const Hertz frequency = option_frequency("--frequency", a.frequency);
    if (const std::string doubt = unlikely_frequency(frequency); !doubt.empty())
        notice("--" + doubt);
    const LossAntennas heights = heights_of(a);
    const Meters wall = a.wall ? option_length("--wall", *a.wall) : Meters{0};
    std::vector<Meters> distances;
    for (const auto& text : a.distances) distances.push_back(option_length("--distance", text));
    if (!a.out.empty()) {
        check_picture_name(a.out);
        distances = curve_between(distances);
    }
    std::vector<ModelLoss> models = models_of(a.models);
    for (ModelLoss& m : models)
        m.rows = loss_table(m.model, m.parameters, frequency, distances, heights, wall);
    if (!a.out.empty()) return draw_losses(models, frequency, a.out);
    if (!a.json) return print_losses(models);
    if (models.size() == 1) {
        fmt::print("{}", to_json(document_of(models.front(), frequency, a)));
        return;
    }
    Array list;
    for (const ModelLoss& m : models) list.emplace_back(document_of(m, frequency, a));
    fmt::print("{}", to_json(Value(std::move(list))));
}

}  // namespace rovernet::cli
