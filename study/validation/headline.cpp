// SPDX-License-Identifier: MIT
#include "study/validation/headline.hpp"

#include "pictures/chart/fit_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace rovernet {
namespace {

/// Row of a model, and whether the model is a form of the reference.
struct ModelErrors {
    FitRow row;
    bool is_reference_form = false;
};

/// Rows of all models but the reference, in the order of the panel. The cost of a fitted model is
/// that of its fitted form.
std::vector<ModelErrors> model_rows_of(const ValidationPanel& panel) {
    const double whole = panel.points.front().cost.median;
    std::vector<ModelErrors> rows;
    for (const ValidationPoint& point : panel.points) {
        if (point.series == "reference") continue;
        auto row = std::find_if(rows.begin(), rows.end(),
                                [&](const ModelErrors& r) { return r.row.name == point.label; });
        if (row == rows.end())
            row = rows.insert(rows.end(), {{.name = point.label},
                                           point.series == "the reference with fewer paths"});
        (point.series == "fitted" ? row->row.fitted : row->row.as_given) = point.error;
        row->row.cost = point.cost.median / whole;
    }
    return rows;
}

/// Removes each row with the same errors as a row before it: of free space and two_ray in a
/// building, free space stays, whatever their costs were this time.
void remove_equals(std::vector<ModelErrors>& rows) {
    for (std::size_t i = 0; i < rows.size();) {
        const FitRow& row = rows[i].row;
        const auto end = rows.begin() + static_cast<std::ptrdiff_t>(i);
        const bool is_known = std::any_of(rows.begin(), end, [&](const ModelErrors& before) {
            return before.row.as_given == row.as_given && before.row.fitted == row.fitted;
        });
        if (is_known)
            rows.erase(end);
        else
            ++i;
    }
}

FitPanel fit_panel_of(const ValidationPanel& panel) {
    std::vector<ModelErrors> rows = model_rows_of(panel);
    remove_equals(rows);
    std::stable_sort(rows.begin(), rows.end(), [](const ModelErrors& a, const ModelErrors& b) {
        return a.row.cost < b.row.cost;
    });
    const auto best =
        std::min_element(rows.begin(), rows.end(), [](const ModelErrors& a, const ModelErrors& b) {
            if (a.is_reference_form != b.is_reference_form) return b.is_reference_form;
            return a.row.least_error() < b.row.least_error();
        });
    if (best != rows.end()) best->row.best = true;
    FitPanel out{.title = panel.title, .reference = panel.points.front().label};
    if (!out.title.empty())
        out.title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(out.title[0])));
    for (ModelErrors& row : rows) out.rows.push_back(std::move(row.row));
    return out;
}

/// Sentence on the best model of a scene: "In the office, multi_wall errs by 0.04 ...".
std::string subtitle_of(const ValidationPanel& scene, const FitPanel& panel) {
    for (const FitRow& row : panel.rows) {
        if (!row.best) continue;
        std::string out = fmt::format("In the {}, the error of {} is {:.2g}", scene.title, row.name,
                                      row.fitted.value_or(row.as_given.value_or(0)));
        if (row.fitted && row.as_given)
            out += fmt::format(" after the fit ({:.2g} before)", *row.as_given);
        return out +
               fmt::format(", at {} of the cost of {}.", cost_text(row.cost), panel.reference);
    }
    return "";
}

const ValidationChart& path_loss_chart(const Validation& validation) {
    for (const ValidationChart& chart : validation.charts)
        if (chart.name == "path_loss") return chart;
    throw std::out_of_range("no chart path_loss in the validation");
}

}  // namespace

std::string headline_svg(const Validation& validation) {
    const ValidationChart& chart = path_loss_chart(validation);
    std::vector<const ValidationPanel*> scenes;
    for (const ValidationPanel& panel : chart.panels) scenes.push_back(&panel);
    // Buildings first: the open field has the simplest answer.
    std::stable_partition(scenes.begin(), scenes.end(),
                          [](const ValidationPanel* p) { return p->title != "open field"; });
    FitChart out{
        .title = "Which model is good enough? It depends on the scene, and on the fit",
        .subtitle = {},
        .value_label = "error of a run's delivery ratio (0.4: 40 of 100 deliveries are wrong)"};
    for (const ValidationPanel* scene : scenes) out.panels.push_back(fit_panel_of(*scene));
    out.subtitle = subtitle_of(*scenes.front(), out.panels.front());
    out.notes = {fmt::format("Means of {:.0f} runs with robots that move. Cost: CPU time to find "
                             "the receivers of a frame, relative to the reference.",
                             detail_of(scenes.front()->points.front(), "replications")),
                 "The references are computed, not measured: they are the most detailed models of "
                 "rovernet."};
    return fit_chart_svg(out);
}

}  // namespace rovernet
